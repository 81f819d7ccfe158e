// Compares the position errors of the locator with the Cramer-Rao bound, in frames whose only
// source of error is noise. The frames are rendered by the simulator and by an independent renderer
// (dot_image.hpp). Prints a table for docs/accuracy.md in Markdown.
//
//   dotpose_tables bound [--frames N] [--seed S] [--threads N] [--rows R,...]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "dot_image.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/tools/simulate.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr double kNoise = 3;  ///< standard deviation of the noise, in grey levels
constexpr double kBlur_px = 0.7;
constexpr double kDotRadius_px = 0.92;
constexpr double kPaper = 185;
constexpr double kInk = 0.15;  ///< reflectance of the ink relative to the paper

struct BoundFrames {
    int width_px;
    int height_px;
    int spacing_px;
    /// Angle of the image x axis, or a negative value to choose a random angle for each frame.
    double theta_rad;
    double motion_px;  ///< length of the motion blur
    double fall;       ///< relative decrease in illumination across the image
};

constexpr double kAnyAngle = -1;
constexpr std::array kFrames{BoundFrames{188, 120, 11, kAnyAngle, 0, 0},
                             BoundFrames{188, 120, 11, 0, 0, 0},
                             BoundFrames{188, 120, 11, kAnyAngle, 0.5, 0},
                             BoundFrames{188, 120, 11, kAnyAngle, 1, 0},
                             BoundFrames{188, 120, 11, kAnyAngle, 0, 0.3},
                             BoundFrames{188, 120, 11, 0, 1, 0.3},
                             BoundFrames{640, 480, 11, kAnyAngle, 0, 0},
                             BoundFrames{640, 480, 11, 0, 0, 0},
                             BoundFrames{640, 480, 11, kAnyAngle, 1, 0},
                             BoundFrames{640, 480, 11, 0, 1, 0},
                             BoundFrames{640, 480, 11, 0, 1, 0.3},
                             BoundFrames{640, 480, 20, kAnyAngle, 0, 0},
                             BoundFrames{640, 480, 20, 0, 0, 0}};

constexpr double kMotionDirection_rad = 0.4;

DotImage dot_of(const BoundFrames& frames) {
    return {kDotRadius_px,
            kBlur_px,
            {frames.motion_px * std::cos(kMotionDirection_rad),
             frames.motion_px * std::sin(kMotionDirection_rad)}};
}

/// Returns the Cramer-Rao bound on the median position error, in px, given that scale, angle and
/// tilt are known.
double bound_px(const BoundFrames& frames, const DotImage& dot) {
    constexpr int kPhases = 4;  // number of sub-pixel phases per axis
    double xx = 0;              // Fisher information of one dot, averaged over the phases
    double xy = 0;
    double yy = 0;
    for (int phase = 0; phase < kPhases * kPhases; ++phase) {
        for (int i = -DotTable::kReach_px; i <= DotTable::kReach_px; ++i) {
            for (int j = -DotTable::kReach_px; j <= DotTable::kReach_px; ++j) {
                const auto at = [&](int pixel, int step) {
                    return pixel + (step + 0.5) / kPhases - 0.5;
                };
                const Vec2 by = dot.derivative({at(i, phase % kPhases), at(j, phase / kPhases)});
                xx += by.x * by.x / (kPhases * kPhases);
                xy += by.x * by.y / (kPhases * kPhases);
                yy += by.y * by.y / (kPhases * kPhases);
            }
        }
    }
    // Variance of the error from rounding grey levels to integers.
    constexpr double kRounding = 1.0 / 12;
    const double contrast = kPaper * (1 - kInk);
    const double dots =
        1.0 * frames.width_px * frames.height_px / (frames.spacing_px * frames.spacing_px);
    const double scale = dots * contrast * contrast / (kNoise * kNoise + kRounding);
    const double variance_px2 = (xx + yy) / 2 / (xx * yy - xy * xy) / scale;
    // Median length of a 2D vector whose components are independent standard normal variables.
    const double median = std::sqrt(2 * std::numbers::ln2);
    return median * std::sqrt(variance_px2);
}

Shot shot_of(const BoundFrames& frames, std::uint64_t seed, int index) {
    Setup setup = setup_of(seed, frames.width_px, frames.height_px);
    setup.camera.mm_per_px = setup.pattern.spacing_mm / frames.spacing_px;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    shot.page.pattern.dot_mm = 2 * kDotRadius_px * setup.camera.mm_per_px;
    if (frames.theta_rad >= 0) shot.pose.theta_rad = frames.theta_rad;
    shot.pose.tilt_x_rad = shot.pose.tilt_y_rad = 0;
    Rng rng(shot.seed, 1);
    shot.imperfections = {};
    shot.imperfections.paper_level = kPaper;
    shot.imperfections.ink_reflectance = kInk;
    shot.imperfections.noise_sigma = kNoise;
    shot.imperfections.blur_sigma_px = kBlur_px;
    shot.imperfections.motion_px = {frames.motion_px * std::cos(kMotionDirection_rad),
                                    frames.motion_px * std::sin(kMotionDirection_rad)};
    shot.imperfections.fall = frames.fall;
    shot.imperfections.fall_direction_rad = rng.uniform(0, 2 * std::numbers::pi);
    shot.imperfections.sub_pixels = 8;  // fine sampling, because errors of 0.0005 px matter
    return shot;
}

/// Prints one row and returns the number of wrong fixes.
int print_row(const BoundFrames& frames, std::uint64_t count, const TableRun& run) {
    const DotImage dot = dot_of(frames);
    const DotTable table(dot);
    const double bound = bound_px(frames, dot);
    const std::string angle =
        frames.theta_rad < 0 ? "any" : fmt::format("{:.0f}", frames.theta_rad * kDegrees);
    std::string row = fmt::format("| {} x {} | {} | {} | {} | {:.0f} | {:.5f} |", frames.width_px,
                                  frames.height_px, frames.spacing_px, angle, frames.motion_px,
                                  100 * frames.fall, bound);
    int wrong = 0;
    for (const bool is_simulator : {true, false}) {
        FrameRun frame_run;
        frame_run.frames = static_cast<int>(count);
        frame_run.frame_at = [&](int index) {
            const Shot shot = shot_of(frames, run.seed, index);
            return is_simulator ? known_frame(shot)
                                : KnownFrame{draw_with(table, shot), truth_of(shot), {}, {}};
        };
        frame_run.options.front().effort = Effort::once;
        const Score score = score_of(run.evaluate(row, std::move(frame_run)).front());
        const double error_px =
            score.position_um.median / 1000 / kDefaultSpacing_mm * frames.spacing_px;
        row += fmt::format(" {:.5f}, {:.2f} | {:.2f} {:.2f} {:.2f} |", error_px, error_px / bound,
                           score.normalised[0], score.normalised[1], score.normalised[2]);
        wrong += score.wrong;
    }
    fmt::print("{}\n", row);
    std::fflush(stdout);
    return wrong;
}

}  // namespace

bool bound_table(TableRun& run) {
    std::uint64_t count = 1000;
    std::vector<int> rows;
    run.add_count("--frames", count, "Number of frames in each row");
    run.command.add_option("--rows", rows, "Numbers of the rows to measure, from 1; default all")
        ->delimiter(',');
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    fmt::print(
        "| image, px | spacing, px | angle, degrees | motion, px | fall of the light, % "
        "| bound, px | simulator: median error, px, and its ratio to the bound "
        "| error^2 / variance of x, y, theta | second renderer: error, ratio "
        "| error^2 / variance |\n"
        "|--:|--:|--:|--:|--:|--:|---|---|---|---|\n");
    int wrong = 0;
    for (std::size_t i = 0; i < kFrames.size(); ++i) {
        if (rows.empty() || std::ranges::find(rows, static_cast<int>(i) + 1) != rows.end())
            wrong += print_row(kFrames[i], count, run);
    }
    return wrong == 0;
}

}  // namespace dotpose::tables
