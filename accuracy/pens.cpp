// Simulates the frames of a pen, and measures the errors of the calibrated pen tip and of the
// recorded strokes (docs/pens.md). Prints tables in Markdown, and --update also writes them to the
// document.
//
//   dotpose_tables pens [--pivots N] [--words N] [--seed S] [--threads N] [--draw FILE]
//                       [--update DOCUMENT]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "../tests/pen_frames.hpp"
#include "calibration.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/files/write_file.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/ink.hpp"
#include "dotpose/tools/simulate_pen.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr int kPivotFrames = 30;
constexpr double kPenRate_hz = 200;
constexpr int kStrokesPerWord = 4;
constexpr int kDrawnStrokes = 12;

/// Returns a shot taken by the camera of a pen. The seed also determines the printing errors.
Shot pen_shot(std::uint64_t seed, std::uint64_t index) {
    Shot shot = test::pen_shot(seed, index);
    shot.page.seed = seed;
    return shot;
}

PivotCalibration calibrated(std::uint64_t seed, double max_tilt_deg) {
    CalibrateOptions options;
    options.pattern.spacing_mm = test::kPenSpacing_mm;
    Rng rng(seed, 7);
    const double x_mm = rng.uniform(1000, 5000);
    const double y_mm = rng.uniform(1000, 5000);
    std::vector<PenPose> poses;
    for (int i = 0; i < kPivotFrames; ++i)
        poses.push_back(test::pivoted(x_mm, y_mm, max_tilt_deg / kDegrees, rng));
    const auto frame_at = [&](int i) {
        const auto index = static_cast<std::size_t>(i);
        return render(shot_of_pen(pen_shot(seed, index), test::kTip, poses[index]));
    };
    return calibrate_pivot(kPivotFrames, frame_at, test::pen_camera(), options);
}

struct PivotTally {
    std::array<Errors, 4> errors;  ///< errors of x_mm, y_mm, z_mm and rest_mm of the tip
    double residual_mm = 0;
    double error_ratio = 0;

    void operator+=(const PivotTally& other) {
        for (std::size_t i = 0; i < errors.size(); ++i)
            errors[i] += other.errors[i];
        residual_mm += other.residual_mm;
        error_ratio += other.error_ratio;
    }
};

void measure_pivot(std::uint64_t seed, double max_tilt_deg, PivotTally& tally) {
    const PivotCalibration pivot = calibrated(seed, max_tilt_deg);
    const PenTip tip = pivot.camera.tip.value();
    const auto add = [&](std::size_t i, double error_mm, const char* key) {
        tally.errors[i].add(error_mm, pivot.camera.sigma.at(key));
    };
    add(0, tip.x_mm - test::kTip.x_mm, "tip_x_mm");
    add(1, tip.y_mm - test::kTip.y_mm, "tip_y_mm");
    add(2, tip.z_mm - test::kTip.z_mm, "tip_z_mm");
    add(3, tip.rest_mm - test::kTip.rest_mm, "tip_rest_mm");
    tally.residual_mm += pivot.residual_mm;
    tally.error_ratio += pivot.error_ratio;
}

std::string pivot_row(double max_tilt_deg, const Count<PivotTally>& count) {
    std::string text = fmt::format("| {} | {} |", max_tilt_deg, count.done);
    for (const Errors& errors : count.tally.errors) {
        text += fmt::format(" {:.2f} | {:.2f} | {} |", 1000 * errors.rms(), 1000 * errors.largest,
                            errors.normalised_text());
    }
    const auto done = static_cast<double>(count.done);
    return text + fmt::format(" {:.2f} | {:.2f} |\n", 1000 * count.tally.residual_mm / done,
                              count.tally.error_ratio / done);
}

struct InkTally {
    std::uint64_t frames = 0;
    std::uint64_t located = 0;
    Errors raw;
    Errors smoothed;
    std::uint64_t strokes = 0;
    std::uint64_t found = 0;  ///< number of strokes in the recorded ink
    /// Number of stroke starts and ends with an error above one frame.
    std::uint64_t late_ends = 0;
    int largest_delay = 0;  ///< largest error of a stroke start or end, in frames

    void operator+=(const InkTally& other) {
        frames += other.frames;
        located += other.located;
        raw += other.raw;
        smoothed += other.smoothed;
        strokes += other.strokes;
        found += other.found;
        late_ends += other.late_ends;
        largest_delay = std::max(largest_delay, other.largest_delay);
    }
};

/// Indices of the first and the last frame of a stroke.
using StrokeFrames = std::pair<std::int64_t, std::int64_t>;

std::vector<StrokeFrames> true_strokes(const std::vector<PenSample>& path) {
    std::vector<StrokeFrames> strokes;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (!path[i].is_down) continue;
        const auto frame = static_cast<std::int64_t>(i);
        if (i == 0 || !path[i - 1].is_down) strokes.emplace_back(frame, frame);
        strokes.back().second = frame;
    }
    return strokes;
}

std::int64_t frame_of(const InkPoint& point) {
    return std::llround(point.t_s * kPenRate_hz);
}

void compare_strokes(const std::vector<PenSample>& path, const InkPage& page, InkTally& tally) {
    const std::vector<StrokeFrames> truth = true_strokes(path);
    tally.strokes += truth.size();
    tally.found += page.strokes.size();
    for (const InkStroke& stroke : page.strokes) {
        for (const InkPoint& point : stroke) {
            const PenPose& pose = path[static_cast<std::size_t>(frame_of(point))].pose;
            tally.smoothed.add(std::hypot(point.x_mm - pose.x_mm, point.y_mm - pose.y_mm), 1);
        }
    }
    if (truth.size() != page.strokes.size()) return;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        for (const auto delay : {frame_of(page.strokes[i].front()) - truth[i].first,
                                 frame_of(page.strokes[i].back()) - truth[i].second}) {
            tally.late_ends += std::abs(delay) > 1 ? 1 : 0;
            tally.largest_delay = std::max(tally.largest_delay, static_cast<int>(std::abs(delay)));
        }
    }
}

/// Simulates writing with a pen whose tip was calibrated by `calibrate_pivot`. Returns the recorded
/// ink.
InkPage measure_ink(std::uint64_t seed, int strokes, InkTally& tally) {
    FollowerOptions options;
    options.camera = calibrated(scramble(seed), 40).camera;
    options.spacing_mm = test::kPenSpacing_mm;
    options.fits_space_pose = true;
    Follower follower(options);
    const std::vector<PenSample> path =
        simulate_handwriting({2000, 3000, strokes, kPenRate_hz, seed});
    std::vector<InkSample> samples;
    for (std::size_t i = 0; i < path.size(); ++i) {
        ++tally.frames;
        const GreyImage image = render(shot_of_pen(pen_shot(seed, i), test::kTip, path[i].pose));
        const auto time_us = static_cast<std::int64_t>(std::llround(path[i].t_s * 1e6));
        const Located now = follower.follow(image.view(), time_us).located;
        if (!now.tip) continue;
        ++tally.located;
        const CameraLean lean = lean_of(now.space->camera.rotation);
        samples.push_back({path[i].t_s, "", now.tip->x_mm, now.tip->y_mm, now.tip->height_mm,
                           now.tip->sigma_mm(0), now.tip->sigma_mm(1), now.tip->sigma_mm(2),
                           lean.tilt_rad, lean.azimuth_rad});
        if (!path[i].is_down) continue;
        const PenPose& pose = path[i].pose;
        tally.raw.add(std::hypot(now.tip->x_mm - pose.x_mm, now.tip->y_mm - pose.y_mm), 1);
    }
    const std::vector<InkPage> pages = ink_of(samples);
    if (pages.empty()) return {};
    compare_strokes(path, pages.front(), tally);
    return pages.front();
}

}  // namespace

bool pens_table(TableRun& run) {
    std::uint64_t pivots = 100;
    std::uint64_t words = 20;
    std::string picture;
    run.add_count("--pivots", pivots, "Number of calibrations for each largest tilt");
    run.add_count("--words", words, "Number of words to write");
    run.command.add_option("--draw", picture, "Also draw the ink of three lines (SVG)");
    run.add_seed();
    run.add_threads();
    run.add_update();
    if (!run.parse()) return true;
    bool is_complete = true;
    if (pivots > 0) {
        std::string text =
            "| tilts to | pens | x, µm rms | largest | error² / variance | y, µm rms | largest | "
            "error² / variance | z, µm rms | largest | error² / variance | rest, µm rms | largest "
            "| error² / variance | residual, µm | ratio |\n"
            "|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
        for (const double tilt_deg : {15.0, 40.0}) {
            const auto count = run.count<PivotTally>(
                fmt::format("tilts to {}", tilt_deg), pivots,
                [&](std::uint64_t i, PivotTally& tally) {
                    measure_pivot(scramble(run.seed + 1000 * i), tilt_deg, tally);
                });
            text += pivot_row(tilt_deg, count);
            is_complete &= count.is_complete();
        }
        run.print_block("pivot", text);
    }
    if (words > 0) {
        const auto count = run.count<InkTally>("ink", words, [&](std::uint64_t i, InkTally& tally) {
            measure_ink(scramble(run.seed + i), kStrokesPerWord, tally);
        });
        const InkTally& tally = count.tally;
        run.print_block(
            "ink",
            fmt::format("| frames | located | raw, µm rms | ink, µm rms | largest | strokes | "
                        "found | ends off by more than a frame | largest, frames |\n"
                        "|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
                        "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {} | {} | {} | {} |\n",
                        tally.frames, tally.located, 1000 * tally.raw.rms(),
                        1000 * tally.smoothed.rms(), 1000 * tally.smoothed.largest, tally.strokes,
                        tally.found, tally.late_ends, tally.largest_delay));
        is_complete &= count.is_complete();
    }
    if (!picture.empty()) {
        InkTally tally;
        write_file(picture, ink_svg(measure_ink(scramble(run.seed), kDrawnStrokes, tally)));
    }
    run.update_document();
    return is_complete;
}

}  // namespace dotpose::tables
