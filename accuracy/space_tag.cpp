// Compares poses in space computed from a sheet with poses computed from an AprilTag that fills the
// same view (docs/pose-in-space.md). Prints a table in Markdown, and --update also writes it to the
// document.
//
//   dotpose_tables space_tag [--frames N] [--seed S] [--threads N] [--update DOCUMENT]
//
// Requires libapriltag and the calibration module of OpenCV.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "dotpose/files/error.hpp"
#include "space_apriltag.hpp"
#include "space_view.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

#if defined(DOTPOSE_HAS_APRILTAG) && defined(DOTPOSE_HAS_CALIB3D)

/// Errors of one method.
struct TagErrors {
    std::uint64_t count = 0;
    double position_squares = 0;
    double largest_mm = 0;
    double rotation_squares = 0;
    double largest_rad = 0;

    void add(const SpaceVector& error) {
        const double mm = error.head<3>().norm();
        const double rad = error.tail<3>().norm();
        ++count;
        position_squares += mm * mm;
        rotation_squares += rad * rad;
        largest_mm = std::max(largest_mm, mm);
        largest_rad = std::max(largest_rad, rad);
    }
    TagErrors& operator+=(const TagErrors& other) {
        count += other.count;
        position_squares += other.position_squares;
        rotation_squares += other.rotation_squares;
        largest_mm = std::max(largest_mm, other.largest_mm);
        largest_rad = std::max(largest_rad, other.largest_rad);
        return *this;
    }
    double position_rms_mm() const {
        return std::sqrt(position_squares / static_cast<double>(count));
    }
    double rotation_rms_rad() const {
        return std::sqrt(rotation_squares / static_cast<double>(count));
    }
};

/// Errors of dotpose, of OpenCV given the dots found by dotpose, and of libapriltag.
struct TagTally {
    std::array<TagErrors, 3> methods;

    void operator+=(const TagTally& other) {
        for (std::size_t i = 0; i < methods.size(); ++i)
            methods[i] += other.methods[i];
    }
};
constexpr std::array kMethods = {"dotpose", "OpenCV, IPPE, same dots", "libapriltag"};

void compare(const Shot& shot, int id, TagTally& tally) {
    auto& [ours, opencv, tag] = tally.methods;
    const TrueSpacePose truth = true_space_pose(shot);
    const SpaceReading reading(shot);
    if (reading.pose() && !reading.pose()->is_ambiguous()) {
        ours.add(space_error(reading.pose()->camera, truth));
        opencv.add(space_error(reading.opencv_pose(), truth));
    }
    if (const auto error = apriltag_error(shot, id)) tag.add(*error);
}

std::string rows_text(const SpaceLens& lens, double tilt_deg, const TagTally& tally,
                      std::uint64_t frames) {
    std::string text;
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
        const TagErrors& e = tally.methods[i];
        text +=
            fmt::format("| {} | {} | {} | {} of {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} |\n",
                        lens.title, tilt_deg, kMethods[i], e.count, frames, e.position_rms_mm(),
                        e.largest_mm, e.rotation_rms_rad() * kDegrees, e.largest_rad * kDegrees);
    }
    return text;
}

bool measure_tags(std::uint64_t frames, TableRun& run) {
    constexpr int kIds = 500;  // the family has 587 tags
    std::string text =
        "| field | tilt | method | poses | position, mm rms | largest | rotation, degrees rms | "
        "largest |\n|--:|--:|---|--:|--:|--:|--:|--:|\n";
    bool is_complete = true;
    std::uint64_t row = 0;  // each row uses different frames
    for (SpaceLens lens : kSpaceLenses) {
        lens.k = 0;  // libapriltag has no lens model
        for (const double tilt_deg : {0.0, 15.0, 30.0, 45.0}) {
            const std::uint64_t seed = scramble(run.seed + 2000 + row++);
            const std::string what = fmt::format("{}, tilt {}", lens.title, tilt_deg);
            const auto count =
                run.count<TagTally>(what, frames, [&](std::uint64_t i, TagTally& tally) {
                    compare(space_shot(lens, tilt_deg, seed, i), static_cast<int>(i % kIds), tally);
                });
            text += rows_text(lens, tilt_deg, count.tally, frames);
            is_complete &= count.is_complete();
        }
    }
    run.print_block("space tag", text);
    run.update_document();
    return is_complete;
}

#else

bool measure_tags(std::uint64_t, TableRun&) {
    throw Error(
        "this program was built without libapriltag or OpenCV's calibration module: install "
        "libapriltag-dev and libopencv-calib3d-dev, and configure again");
}

#endif

}  // namespace

bool space_tag_table(TableRun& run) {
    std::uint64_t frames = 200;
    run.add_count("--frames", frames, "Number of frames for each tilt");
    run.add_seed();
    run.add_threads();
    run.add_update();
    return !run.parse() || measure_tags(frames, run);
}

}  // namespace dotpose::tables
