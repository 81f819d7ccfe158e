// Measures the fraction of frames that the first attempt locates, and the time per frame, for
// several tilts of the camera.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "benchmarks.hpp"
#include "frames.hpp"

namespace dotpose::bench {
namespace {

/// Returns a frame from a tilted camera. The tilt axis is different for each frame.
KnownFrame tilted_frame(const Setup& setup, int tilt_deg, int index) {
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    const double axis_rad = index * std::numbers::phi * 2 * std::numbers::pi;
    const double tilt_rad = tilt_deg * std::numbers::pi / 180;
    shot.pose.tilt_x_rad = tilt_rad * std::cos(axis_rad);
    shot.pose.tilt_y_rad = tilt_rad * std::sin(axis_rad);
    return {render(shot), truth_of(shot), {}, {}};
}

TiltTimes time_tilt(const CameraModel& camera, int tilt_deg, int count, int passes) {
    Setup setup;
    setup.seed = kSeed + static_cast<std::uint64_t>(tilt_deg);
    setup.camera = camera;
    const auto memory = std::make_unique<LargeMemory>();
    TimedFrames timed = time_frames(
        render_frames(count, [&](int i) { return tilted_frame(setup, tilt_deg, i); }), passes,
        [&](const ImageView& image) { return Locator(*memory, DeviceOptions{}).locate(image); });
    std::ranges::nth_element(timed.fastest_us, timed.fastest_us.begin() + count / 2);
    return {camera, tilt_deg, count, timed.by_first_attempt,
            timed.fastest_us[static_cast<std::size_t>(count / 2)]};
}

}  // namespace

std::vector<TiltTimes> time_tilted_frames(bool is_quick) {
    std::vector<TiltTimes> all;
    CameraModel vga;
    vga.width_px = 640;
    vga.height_px = 480;
    for (const auto& [camera, count] : {std::pair{CameraModel(), 300}, std::pair{vga, 60}}) {
        for (const int tilt_deg : {0, 5, 10, 15, 20})
            all.push_back(
                time_tilt(camera, tilt_deg, is_quick ? count / 10 : count, is_quick ? 2 : 7));
    }
    return all;
}

std::string tilt_table(const std::vector<TiltTimes>& times) {
    std::string table =
        "| frame, px | tilt, degrees | frames | located by the first attempt, % | median, µs | / "
        "that at 0 "
        "degrees |\n"
        "|---|--:|--:|--:|--:|--:|\n";
    double straight_us = 1;
    for (const TiltTimes& t : times) {
        if (t.tilt_deg == 0) straight_us = t.median_us;
        table += fmt::format("| {} x {} | {} | {} | {:.1f} | {:.1f} | {:.2f} |\n",
                             t.camera.width_px, t.camera.height_px, t.tilt_deg, t.frames,
                             100.0 * t.by_first_attempt / t.frames, t.median_us,
                             t.median_us / straight_us);
    }
    return table;
}

}  // namespace dotpose::bench
