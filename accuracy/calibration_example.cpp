#include <filesystem>
#include <string>

#include <fmt/core.h>

#include "../tests/unit/calibrate/frames.hpp"
#include "calibration.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::tables {
namespace {

namespace fs = std::filesystem;
using namespace calibrate_test;

/// Writes frame_at(0), ..., frame_at(frames - 1) to a folder.
template <typename FrameAt>
void write_frames(const fs::path& folder, int frames, FrameAt frame_at) {
    fs::create_directories(folder);
    for (int i = 0; i < frames; ++i)
        write_pgm(folder / fmt::format("frame_{:06}.pgm", i), frame_at(i).view());
}

/// Writes the sheet file for the sheets in `kTable`. The positions of the sheets are rounded to 1
/// mm and their angles are 0, as if the poses had been measured with a ruler.
void write_sheets(const fs::path& path) {
    fs::remove(path);
    SheetFile file(path);
    const std::vector<SheetEntry> entries = sheets_of_table();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        SheetEntry entry = entries[i];
        const auto to_mm = [](double mm) { return std::round(mm) / 1000; };
        entry.world = WorldPose{to_mm(kTable[i].x_mm), -to_mm(kTable[i].y_mm), 0};
        file.add(entry);
    }
    file.save();
}

}  // namespace

void write_example(const std::string& folder, std::uint64_t seed) {
    const fs::path root = folder;
    const CameraModel camera = paper_camera();
    write_frames(root / "frames", 20, [&](int i) { return nominal_frame(camera, seed, i); });
    write_frames(root / "turn", 12, [&](int i) {
        return robot_frame(camera, seed + 1, i, kPivot_x_mm, kPivot_y_mm, 30 * i * kDegree_rad);
    });
    write_frames(root / "line", 10, [&](int i) {
        // The robot heads along x. The x axis of the image is a quarter turn to the left of the
        // heading.
        return robot_frame(camera, seed + 2, i, kPivot_x_mm + 5 * i, kPivot_y_mm,
                           -90 * kDegree_rad);
    });
    const CameraModel wide = wide_camera();
    Table table = kTable;
    table[1].print = {1.0021, 0.9988};
    table[2].print = {0.9982, 1.0012};
    table[3].print = {1.0006, 0.9990};
    write_frames(root / "wide", 20, [&](int i) { return nominal_frame(wide, seed + 3, i); });
    write_frames(root / "seams", 60, [&](int i) { return seam_frame(table, wide, seed + 4, i); });
    write_sheets(root / "sheets.json");
}

}  // namespace dotpose::tables
