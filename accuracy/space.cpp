// Measures the errors of poses in space and compares them with the Cramer-Rao bound
// (docs/pose-in-space.md). Prints a table in Markdown, and --update also writes it to the document.
//
//   dotpose_tables space [--frames N] [--seed S] [--threads N] [--tilts D,...]
//                        [--update DOCUMENT]
//
// The exit status is 1 if a wrong pose is not reported as ambiguous.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "calibration.hpp"
#include "space_view.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

/// Standard deviation of the print jitter in the `nominal` preset, per axis.
constexpr double kJitter_mm = 0.010;
/// Errors of one method. The error of each coordinate is divided by the Cramer-Rao bound on its
/// standard deviation.
struct SpaceErrors {
    std::array<Errors, 6> coordinates;
    Errors all;  ///< square roots of the normalised squared errors (`normalised_square`)

    SpaceErrors& operator+=(const SpaceErrors& other) {
        for (std::size_t i = 0; i < coordinates.size(); ++i)
            coordinates[i] += other.coordinates[i];
        all += other.all;
        return *this;
    }
};

struct SpaceTally {
    std::uint64_t frames = 0;
    std::uint64_t located = 0;
    std::uint64_t wrong = 0;
    std::uint64_t ambiguous = 0;
    std::uint64_t second = 0;  ///< number of frames with a second pose, even if ruled out
    SpaceErrors ours;
    SpaceErrors opencv;

    void operator+=(const SpaceTally& other) {
        frames += other.frames;
        located += other.located;
        wrong += other.wrong;
        ambiguous += other.ambiguous;
        second += other.second;
        ours += other.ours;
        opencv += other.opencv;
    }
};

void add(const SpaceVector& error, const SpaceMatrix& covariance, const SpaceMatrix& bound,
         SpaceErrors& errors) {
    for (Eigen::Index i = 0; i < 6; ++i) {
        errors.coordinates[static_cast<std::size_t>(i)].add(
            error[i] / std::sqrt(bound(i, i)), std::sqrt(covariance(i, i) / bound(i, i)));
    }
    errors.all.add(std::sqrt(normalised_square(error, covariance)), 1);
}

void measure(const Shot& shot, SpaceTally& tally) {
    ++tally.frames;
    const SpaceReading reading(shot);
    const auto& pose = reading.pose();
    if (!pose) return;
    ++tally.located;
    const TrueSpacePose truth = true_space_pose(shot);
    const SpaceMatrix bound = space_bound(shot, kJitter_mm);
    const SpaceVector error = space_error(pose->camera, truth);
    const SpaceMatrix covariance = matrix_of(pose->covariance);
    tally.second += pose->second ? 1 : 0;
    if (pose->is_ambiguous()) {
        ++tally.ambiguous;
        return;
    }
    if (normalised_square(error, covariance) > kMaxNormalisedSquare) ++tally.wrong;
    add(error, covariance, bound, tally.ours);
#ifdef DOTPOSE_HAS_CALIB3D
    add(space_error(reading.opencv_pose(), truth), covariance, bound, tally.opencv);
#endif
}

/// Returns two table cells: the rms errors of the three position coordinates, and those of the
/// three rotation coordinates, relative to the bound.
std::string ratios_text(const SpaceErrors& errors) {
    const auto& e = errors.coordinates;
    if (e[0].count == 0) return " - | - |";
    return fmt::format(" {:.2f} {:.2f} {:.2f} | {:.2f} {:.2f} {:.2f} |", e[0].rms(), e[1].rms(),
                       e[2].rms(), e[3].rms(), e[4].rms(), e[5].rms());
}

std::string row_text(const SpaceLens& lens, double tilt_deg, const SpaceTally& tally) {
    const auto& e = tally.ours.coordinates;
    return fmt::format("| {} | {} | {} of {} |{} {} {} {} | {} {} {} | {:.2f} | {} | {} | {} |{}\n",
                       lens.title, tilt_deg, tally.located, tally.frames, ratios_text(tally.ours),
                       e[0].normalised_text(), e[1].normalised_text(), e[2].normalised_text(),
                       e[3].normalised_text(), e[4].normalised_text(), e[5].normalised_text(),
                       tally.ours.all.squares / (6 * tally.ours.all.count), tally.second,
                       tally.ambiguous, tally.wrong, ratios_text(tally.opencv));
}

}  // namespace

bool space_table(TableRun& run) {
    std::uint64_t frames = 200;
    std::vector<double> tilts_deg{0, 5, 15, 25, 35, 45};
    run.add_count("--frames", frames, "Number of frames for each tilt");
    run.command.add_option("--tilts", tilts_deg, "Tilts, in degrees")
        ->delimiter(',')
        ->capture_default_str();
    run.add_seed();
    run.add_threads();
    run.add_update();
    if (!run.parse()) return true;
    std::string text =
        "| field | tilt | located | error / bound: x y z | about x y z | error² / variance: x y z "
        "| "
        "about x y z | all six | with a second pose | ambiguous | wrong | OpenCV, error / bound: "
        "x y z | about x y z |\n|--:|--:|--:|---|---|---|---|--:|--:|--:|--:|---|---|\n";
    bool is_right = true;
    std::uint64_t row = 0;  // each row uses different frames
    for (const SpaceLens& lens : kSpaceLenses) {
        for (const double tilt_deg : tilts_deg) {
            const std::uint64_t seed = scramble(run.seed + row++);
            const std::string what = fmt::format("{}, tilt {}", lens.title, tilt_deg);
            const auto count =
                run.count<SpaceTally>(what, frames, [&](std::uint64_t i, SpaceTally& tally) {
                    measure(space_shot(lens, tilt_deg, seed, i), tally);
                });
            text += row_text(lens, tilt_deg, count.tally);
            is_right &= count.tally.wrong == 0 && count.is_complete();
        }
    }
    run.print_block("space", text);
    run.update_document();
    return is_right;
}

}  // namespace dotpose::tables
