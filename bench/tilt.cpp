// Measures how many frames of a tilted camera the first attempt locates, and their times.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "benchmarks.hpp"
#include "frames.hpp"

namespace dotpose::bench {
namespace {

std::vector<KnownFrame> tilted_frames(const CameraModel& camera, int tilt_deg, int count) {
    Setup setup;
    setup.seed = kSeed + static_cast<std::uint64_t>(tilt_deg);
    setup.camera = camera;
    std::vector<KnownFrame> frames(static_cast<std::size_t>(count));
    on_all_cores(count, [&](int i) {
        Shot shot = draw_shot(setup, static_cast<std::uint64_t>(i));
        // The axis of the tilt is another one in each frame.
        const double axis_rad = i * std::numbers::phi * 2 * std::numbers::pi;
        const double tilt_rad = tilt_deg * std::numbers::pi / 180;
        shot.pose.tilt_x_rad = tilt_rad * std::cos(axis_rad);
        shot.pose.tilt_y_rad = tilt_rad * std::sin(axis_rad);
        frames[static_cast<std::size_t>(i)] = {render(shot), truth_of(shot), {}, {}};
    });
    return frames;
}

TiltTimes time_frames(const CameraModel& camera, int tilt_deg, int count, int passes) {
    const std::vector<KnownFrame> frames = tilted_frames(camera, tilt_deg, count);
    const auto memory = std::make_unique<LargeMemory>();
    std::vector<double> fastest_us(frames.size(), 1e9);
    TiltTimes times{camera, tilt_deg, count, 0, 0};
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            using Clock = std::chrono::steady_clock;
            const auto start = Clock::now();
            const Fix fix = Locator(*memory).locate(frames[i].image.view());
            const std::chrono::duration<double, std::micro> time = Clock::now() - start;
            fastest_us[i] = std::min(fastest_us[i], time.count());
            if (pass > 0 || fix.status != Status::ok) continue;
            if (!is_right(fix, frames[i].truth)) throw Error("a frame was located wrongly");
            times.at_once += fix.attempt == Attempt::first ? 1 : 0;
        }
    }
    std::ranges::nth_element(fastest_us, fastest_us.begin() + count / 2);
    times.median_us = fastest_us[static_cast<std::size_t>(count / 2)];
    return times;
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
                time_frames(camera, tilt_deg, is_quick ? count / 10 : count, is_quick ? 2 : 7));
    }
    return all;
}

std::string tilt_table(const std::vector<TiltTimes>& times) {
    std::string table =
        "| frame, px | tilt, degrees | frames | located at once, % | median, µs | / that at 0 "
        "degrees |\n"
        "|---|--:|--:|--:|--:|--:|\n";
    double straight_us = 1;
    for (const TiltTimes& t : times) {
        if (t.tilt_deg == 0) straight_us = t.median_us;
        table += fmt::format("| {} x {} | {} | {} | {:.1f} | {:.1f} | {:.2f} |\n",
                             t.camera.width_px, t.camera.height_px, t.tilt_deg, t.frames,
                             100.0 * t.at_once / t.frames, t.median_us, t.median_us / straight_us);
    }
    return table;
}

}  // namespace dotpose::bench
