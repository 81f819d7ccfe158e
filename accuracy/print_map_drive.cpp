// Measures how much a map of the print improves a drive (docs/print-map.md). The drive is that of
// `dotpose_tables drive`. The map is made of other frames. They cover the whole rectangle around
// the path, because a map of the narrow band along the path would be bent.
//
//   dotpose_tables print_map_drive [--frames N]
//
// The exit status is 1 if the repeatability with the map exceeds 0.12 µm.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/core.h>

#include "../tests/mapped_print.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "drive_run.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr double kSpeed_mm_s = 300;
constexpr double kMaxDriveRepeatability_um = 0.12;

/// Returns a state anywhere in the rectangle around the figure eight, at any angle.
test::DriveState state_in_area(std::uint64_t index) {
    Rng rng(500, index);
    test::DriveState state;
    state.x_mm = test::kSeam_mm + rng.uniform(-312, 312);
    state.y_mm = 148.5 + rng.uniform(-112, 112);
    state.yaw_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    return state;
}

PrintMapResult map_of_area(const test::DriveCamera& camera, std::uint64_t frames) {
    PrintMapping mapping({.sheets = test::drive_sheets(), .camera = {}, .earlier = {}});
    cli::ProgressLine line("mapping the area");
    for (std::uint64_t i = 0; i < frames; ++i) {
        line.update(static_cast<std::int64_t>(i), static_cast<std::int64_t>(frames));
        if (cli::interrupted()) throw Error("interrupted");
        mapping.add(camera.frame(state_in_area(i), scramble(500 + i)).view());
    }
    return mapping.solve();
}

/// Errors of the positions of single frames of a drive, without the smoothing of the tracker, for
/// each page.
struct PageErrors {
    std::array<test::PlaceErrors, 2> pages;

    void add(const test::DriveState& truth, const Followed& now) {
        const Located& located = now.located;
        if (!located.place || now.track.verdict != Verdict::accepted) return;
        const auto world = world_place(*located.place);
        pages[located.place->entry->name == "left" ? 0 : 1].add(
            {truth.x_mm, truth.y_mm},
            {world->x_m * 1000 - truth.x_mm, world->y_m * 1000 - truth.y_mm}, {}, located.fix);
    }
    /// Returns the rms of an error over both pages.
    template <typename Error>
    double rms(const Error& error) const {
        double squares = 0;
        double count = 0;
        for (const test::PlaceErrors& page : pages) {
            squares += static_cast<double>(page.count()) * error(page) * error(page);
            count += static_cast<double>(page.count());
        }
        return std::sqrt(squares / count);
    }
    double absolute_um() const {
        return rms([](const test::PlaceErrors& page) { return page.absolute_um(); });
    }
    double repeatability_um() const {
        return rms([](const test::PlaceErrors& page) { return page.repeatability_um(0); });
    }
};

PageErrors drive_with(const test::DriveCamera& camera, const PrintMap& map) {
    PageErrors errors;
    follow_drive(
        test::Drive({.speed_mm_s = kSpeed_mm_s}), camera, 1,
        [&](int, const test::DriveState& truth, const Followed& now) { errors.add(truth, now); },
        map);
    return errors;
}

}  // namespace

bool print_map_drive_table(TableRun& run) {
    std::uint64_t frames = 4800;
    run.add_count("--frames", frames, "Number of frames of the map");
    if (!run.parse()) return true;
    const test::DriveCamera camera(320, 240);
    const PrintMapResult map = map_of_area(camera, frames);
    const PageErrors without = drive_with(camera, {});
    const PageErrors with = drive_with(camera, map.map);
    std::string text =
        "| drive at up to 300 mm/s | repeatability, µm | absolute error, µm |\n|---|--:|--:|\n";
    for (const auto& [name, errors] : {std::pair{"without", &without}, {"with map", &with}}) {
        text += fmt::format("| {} | {:.3f} | {:.3f} |\n", name, errors->repeatability_um(),
                            errors->absolute_um());
    }
    fmt::print("{}", text);
    return with.repeatability_um() <= kMaxDriveRepeatability_um;
}

}  // namespace dotpose::tables
