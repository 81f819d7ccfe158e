// Compares position errors with the Cramer-Rao bound, for frames without printing errors: noise is
// then the only reason for errors. Prints a table of docs/accuracy.md in Markdown.
//
//   dotpose_tables bound [--frames N] [--seed S] [--threads N]
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include <fmt/core.h>

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
    /// Angle of the image x axis. A negative number stands for a random angle in each frame.
    double theta_rad;
    double motion_px;  ///< motion during the exposure, in a random direction in each frame
    double fall;       ///< change of the light across the image
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

/// The image of one dot, computed independently of the simulator and of the core: a disk, convolved
/// with the motion along u, with the Gaussian blur, and with the area of a pixel. The paper is 0,
/// and a point that is completely covered with ink is 1.
class DotImage {
  public:
    explicit DotImage(double motion_px) {
        constexpr int kSteps = 24;
        constexpr double kStep_px = 2 * kDotRadius_px / kSteps;
        for (int i = 0; i < kSteps * kSteps; ++i) {
            const double u = (i % kSteps + 0.5) * kStep_px - kDotRadius_px;
            const double v = (i / kSteps + 0.5) * kStep_px - kDotRadius_px;
            if (std::hypot(u, v) > kDotRadius_px) continue;
            for (int n = 0; n < kMoments; ++n) {
                const double time = (n + 0.5) / kMoments - 0.5;
                points_.push_back({u + time * motion_px, v});
            }
        }
        weight_ = kStep_px * kStep_px / kMoments;
    }

    /// Derivative of a pixel's level with respect to a shift of the dot. The argument is the pixel
    /// centre relative to the dot centre.
    Vec2 derivative(double u, double v) const {
        Vec2 sum;
        for (const Vec2& point : points_) {
            const double du = u - point.x;
            const double dv = v - point.y;
            sum.x -= weight_ * slope(du) * share(dv);
            sum.y -= weight_ * share(du) * slope(dv);
        }
        return sum;
    }

  private:
    static constexpr int kMoments = 8;

    /// Part of the light of a point, at this distance along one axis, that a pixel receives.
    static double share(double distance_px) {
        const double by = 1 / (kBlur_px * std::numbers::sqrt2);
        return (std::erf((distance_px + 0.5) * by) - std::erf((distance_px - 0.5) * by)) / 2;
    }
    static double slope(double distance_px) {
        const auto density = [](double x) {
            return std::exp(-x * x / (2 * kBlur_px * kBlur_px)) /
                   (kBlur_px * std::sqrt(2 * std::numbers::pi));
        };
        return density(distance_px + 0.5) - density(distance_px - 0.5);
    }

    std::vector<Vec2> points_;
    double weight_ = 0;
};

/// Returns the bound on the median error of a position, in px: the error of the mean of all dots,
/// if scale, angle and tilt are known. Averages over the sub-pixel phases of a dot.
double bound_px(const BoundFrames& frames) {
    constexpr int kPhases = 4;
    constexpr int kReach_px = 6;
    const DotImage dot(frames.motion_px);
    Vec2 information;  // along and across the motion. The two are uncorrelated by symmetry.
    for (int phase = 0; phase < kPhases * kPhases; ++phase) {
        for (int i = -kReach_px; i <= kReach_px; ++i) {
            for (int j = -kReach_px; j <= kReach_px; ++j) {
                const Vec2 by = dot.derivative(i + (phase % kPhases + 0.5) / kPhases - 0.5,
                                               j + (phase / kPhases + 0.5) / kPhases - 0.5);
                information.x += by.x * by.x;
                information.y += by.y * by.y;
            }
        }
    }
    const double contrast = kPaper * (1 - kInk);
    constexpr double kRounding = 1.0 / 12;  // variance of rounding to grey levels
    const double dots =
        1.0 * frames.width_px * frames.height_px / (frames.spacing_px * frames.spacing_px);
    const double per_dot =
        contrast * contrast / (kNoise * kNoise + kRounding) / (kPhases * kPhases);
    const double mean_variance = (1 / information.x + 1 / information.y) / 2 / (per_dot * dots);
    // Median of the length of a vector with independent normal components of variance 1.
    const double kMedian = std::sqrt(2 * std::numbers::ln2);
    return kMedian * std::sqrt(mean_variance);
}

Shot shot_of(const BoundFrames& frames, std::uint64_t seed, int index) {
    Setup setup = setup_of(seed, frames.width_px, frames.height_px);
    setup.camera.mm_per_px = setup.pattern.spacing_mm / frames.spacing_px;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    shot.page.pattern.dot_mm = 2 * kDotRadius_px * setup.camera.mm_per_px;
    if (frames.theta_rad >= 0) shot.pose.theta_rad = frames.theta_rad;
    shot.pose.tilt_x_rad = shot.pose.tilt_y_rad = 0;
    Rng rng(shot.seed, 1);
    const double direction_rad = rng.uniform(0, 2 * std::numbers::pi);
    shot.imperfections = {};
    shot.imperfections.paper_level = kPaper;
    shot.imperfections.ink_reflectance = kInk;
    shot.imperfections.noise_sigma = kNoise;
    shot.imperfections.blur_sigma_px = kBlur_px;
    shot.imperfections.motion_px = {frames.motion_px * std::cos(direction_rad),
                                    frames.motion_px * std::sin(direction_rad)};
    shot.imperfections.fall = frames.fall;
    shot.imperfections.fall_direction_rad = rng.uniform(0, 2 * std::numbers::pi);
    shot.imperfections.sub_pixels = 8;  // because errors of 0.0005 px matter
    return shot;
}

/// Prints one row and returns the number of wrong fixes.
int print_row(const BoundFrames& frames, std::uint64_t count, const TableRun& run) {
    FrameRun frame_run;
    frame_run.frames = static_cast<int>(count);
    frame_run.frame_at = [&](int index) { return known_frame(shot_of(frames, run.seed, index)); };
    frame_run.options.front().effort = Effort::once;
    const std::string angle =
        frames.theta_rad < 0 ? "any"
                             : fmt::format("{:.0f}", frames.theta_rad * 180 / std::numbers::pi);
    const std::string what =
        fmt::format("{} x {} px, spacing {} px, angle {}, motion {} px, fall {}", frames.width_px,
                    frames.height_px, frames.spacing_px, angle, frames.motion_px, frames.fall);
    const Score score = score_of(run.evaluate(what, std::move(frame_run)).front());
    const double mm_per_px = kDefaultSpacing_mm / frames.spacing_px;
    const double error_px = score.position_um.median / 1000 / mm_per_px;
    const double bound = bound_px(frames);
    fmt::print(
        "| {} x {} | {} | {} | {} | {:.0f} | {:.5f} | {:.5f} | {:.2f} | {:.2f} {:.2f} {:.2f} |\n",
        frames.width_px, frames.height_px, frames.spacing_px, angle, frames.motion_px,
        100 * frames.fall, bound, error_px, error_px / bound, score.normalised[0],
        score.normalised[1], score.normalised[2]);
    std::fflush(stdout);
    return score.wrong;
}

}  // namespace

bool bound_table(TableRun& run) {
    std::uint64_t count = 1000;
    run.add_count("--frames", count, "Number of frames in each row");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    fmt::print(
        "| image, px | spacing, px | angle, degrees | motion, px | fall of the light, % "
        "| bound, px | median error, px | ratio | error^2 / variance of x, y, theta |\n"
        "|--:|--:|--:|--:|--:|--:|--:|--:|---|\n");
    int wrong = 0;
    for (const BoundFrames& frames : kFrames)
        wrong += print_row(frames, count, run);
    return wrong == 0;
}

}  // namespace dotpose::tables
