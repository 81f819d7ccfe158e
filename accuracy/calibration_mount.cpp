#include <cmath>
#include <cstdio>
#include <string>

#include <fmt/core.h>

#include "../tests/unit/calibrate/frames.hpp"
#include "calibration.hpp"
#include "dotpose/tools/calibrate.hpp"

namespace dotpose::tables {
namespace {

using namespace calibrate_test;

constexpr int kFramesOfCamera = 20;
constexpr int kSpinFrames = 12;
constexpr int kSeamFrames = 200;
/// Maximum relative error of the print scale, per axis.
constexpr double kPrintError = 0.003;

void print_table(const std::string& title, const ErrorTable& table) {
    for (const auto& [key, errors] : table) {
        fmt::print("| {} | {} | {} | {:.5f} | {:.5f} | {} |\n", title, errors.count, key,
                   errors.rms(), errors.largest, errors.normalised_text());
    }
    std::fflush(stdout);
}

void print_head(const std::string& what) {
    fmt::print(
        "\n| {} | values | error of | rms | largest | error² / variance |\n"
        "|---|--:|---|--:|--:|--:|\n",
        what);
}

void spin(const Camera& lens, const CameraModel& model, std::uint64_t seed, ErrorTable& errors) {
    const auto frame_at = [&](int i) {
        return robot_frame(model, seed, i, kPivot_x_mm, kPivot_y_mm, 30 * i * kDegree_rad);
    };
    const SpinCalibration found = calibrate_spin(kSpinFrames, frame_at, lens, {});
    const auto add = [&](const char* key, double x, double y, double sigma) {
        errors[key].add(x, sigma);
        errors[key].add(y, sigma);
    };
    add("reference from the image centre, mm", found.offset_mm.x_mm + kCameraOnRobot_mm.x,
        found.offset_mm.y_mm + kCameraOnRobot_mm.y, found.sigma_mm);
    const PixelPoint pixel = found.camera.reference_px.value();
    const PixelPoint truth =
        pixel_from_image_centre(true_camera(model), {-kCameraOnRobot_mm.x, -kCameraOnRobot_mm.y});
    const double mm = model.mm_per_px;
    add("its pixel, in mm", mm * (pixel.u - truth.u), mm * (pixel.v - truth.v), NAN);
    const Vec2 located = robot_error(found.camera, model, seed + 1).place_mm;
    add("robot located with it, mm", located.x, located.y, NAN);
}

Table draw_table(Rng& rng) {
    Table table = kTable;
    for (Lying& lying : table) {
        lying.print = {1 + rng.uniform(-kPrintError, kPrintError),
                       1 + rng.uniform(-kPrintError, kPrintError)};
    }
    // Stitching keeps the mean print scale of the first sheet, which is 1 in the sheet file. The
    // random print scales of this sheet are therefore normalised to a mean of 1, but can still
    // differ between the two axes.
    const double mean = std::sqrt(table[0].print.x * table[0].print.y);
    table[0].print = {table[0].print.x / mean, table[0].print.y / mean};
    return table;
}

void stitch(const Table& table, const CameraModel& model, const Camera& camera, std::uint64_t seed,
            ErrorTable& errors) {
    const auto frame_at = [&](int i) { return seam_frame(table, model, seed, i); };
    const Stitching found = stitch_sheets(kSeamFrames, frame_at, sheets_of_table(), camera, {});
    for (std::size_t i = 0; i < table.size(); ++i) {
        const SheetEntry& entry = found.sheets[i];
        const StitchedSheet& sheet = found.stitched.at(i);
        const std::string scale = i == 0 ? "print scale of the first sheet" : "print scale";
        errors[scale].add(entry.print_scale_x - table[i].print.x, sheet.sigma_scale_x);
        errors[scale].add(entry.print_scale_y - table[i].print.y, sheet.sigma_scale_y);
        if (i == 0) continue;
        const WorldPose& world = entry.world.value();
        errors["place, mm"].add(1000 * world.x_m - table[i].x_mm, sheet.sigma_mm);
        errors["place, mm"].add(-1000 * world.y_m - table[i].y_mm, sheet.sigma_mm);
        errors["turn, degrees"].add((-world.yaw_rad - table[i].turn_rad) / kDegree_rad,
                                    sheet.sigma_rad / kDegree_rad);
    }
}

Camera calibrated(const CameraModel& model, std::uint64_t seed) {
    const auto frame_at = [&](int i) { return nominal_frame(model, seed, i); };
    return calibrate_lens(kFramesOfCamera, frame_at, {}).camera;
}

/// Calls `work(camera, model, seed, errors)` `count` times with the true camera, and another
/// `count` times with calibrated cameras.
template <typename Work>
void measure_both(const std::string& what, std::uint64_t count, const CameraModel& model,
                  const TableRun& run, Work work) {
    if (count == 0) return;
    print_head(what);
    for (const bool is_estimated : {false, true}) {
        const std::string title = is_estimated ? "calibrated from 20 frames" : "known";
        const auto done =
            run.count<ErrorTable>(what, count, [&](std::uint64_t index, ErrorTable& errors) {
                const std::uint64_t seed = scramble(run.seed) + 1000 * index;
                const Camera camera =
                    is_estimated ? calibrated(model, seed + 500) : true_camera(model);
                work(camera, model, seed, errors);
            });
        print_table(title, done.tally);
    }
}

}  // namespace

void measure_spins(std::uint64_t count, const TableRun& run) {
    measure_both("spin: camera file", count, paper_camera(), run, spin);
}

void measure_stitching(std::uint64_t count, const TableRun& run) {
    measure_both(
        "four sheets: camera file", count, wide_camera(), run,
        [](const Camera& camera, const CameraModel& model, std::uint64_t seed, ErrorTable& errors) {
            Rng rng(seed);
            stitch(draw_table(rng), model, camera, seed, errors);
        });
}

}  // namespace dotpose::tables
