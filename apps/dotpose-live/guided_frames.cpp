#include "guided_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "image_copy.hpp"

namespace dotpose::cli {
namespace {

/// Minimum distance between successive frames collected during a straight drive. A drive over
/// kWantedLength_mm therefore consists of at most 40 steps.
constexpr double kStep_mm = 1.5;
/// Required length of a straight drive. Over this length, an error of 0.01 mm at one end changes
/// the direction by 0.01 degrees.
constexpr double kWantedLength_mm = 60;
/// Number of consecutive frames after which a fast drive is complete.
constexpr std::size_t kWantedRun = 40;
/// Minimum number of consecutive frames in a fast drive that ends early.
constexpr std::size_t kMinRun = 15;
/// Minimum distance between two consecutive frames in a fast drive, in spacings.
constexpr double kMinMotion = 0.5;

/// The pivoting step ends after kWantedPivots frames if all requirements are met, and after
/// kMaxPivots frames in any case.
constexpr std::size_t kWantedPivots = 30;
constexpr std::size_t kMaxPivots = 80;
/// Minimum distance between the tilts (PenLean) of any two collected frames. A frame is skipped if
/// its tilt is closer than this to the tilt of a frame that was already collected.
constexpr double kMinLeanStep = 0.08;
/// A direction is covered if the pen is tilted in this direction by kMinLean_deg or more in at
/// least kMinLeans frames.
constexpr double kMinLean_deg = 10;
constexpr int kMinLeans = 2;
/// The pen must be tilted by this angle or more in at least one frame.
constexpr double kWantedLean_deg = 20;
constexpr std::array<const char*, PivotFrames::kDirections> kSides = {
    "right edge", "lower right corner", "bottom edge", "lower left corner",
    "left edge",  "upper left corner",  "top edge",    "upper right corner"};

double degrees_of(const PenLean& lean) {
    return std::atan(std::hypot(lean.x, lean.y)) * kDegrees;
}

/// Returns the index in kSides of the side towards which a pen is tilted.
std::size_t side_of(const PenLean& lean) {
    const double turns = std::atan2(lean.y, lean.x) / (2 * std::numbers::pi);
    const auto side = std::lround(turns * PivotFrames::kDirections);
    return static_cast<std::size_t>((side + PivotFrames::kDirections) % PivotFrames::kDirections);
}

video::Gauge gauge_of(const char* label, std::size_t count, std::size_t wanted, const char* unit) {
    return {label, fmt::format("{} of {} {}", count, wanted, unit),
            std::min(1.0, static_cast<double>(count) / static_cast<double>(wanted)),
            count >= wanted};
}

}  // namespace

void GuidedFrames::keep(ImageView image) {
    images_.push_back(std::make_shared<const GreyImage>(copy_of(image)));
}

void SpinFrames::take(const GuidedFrame& frame) {
    const double turns = frame.fix.theta_rad() / (2 * std::numbers::pi);
    const int sector = static_cast<int>((turns - std::floor(turns)) * kDirections);
    bool& is_taken = directions_[static_cast<std::size_t>(std::min(sector, kDirections - 1))];
    if (is_taken) return;
    is_taken = true;
    keep(frame.image);
}

std::vector<video::Gauge> SpinFrames::gauges() const {
    return {gauge_of("turn", images_.size(), kDirections, "directions")};
}

std::string SpinFrames::advice() const {
    return images_.size() < 2 ? "turn the robot on the spot" : "go on to a full turn";
}

double DriveFrames::distance_mm(const Place& from, const Place& to) {
    return std::hypot(to.x_mm - from.x_mm, to.y_mm - from.y_mm);
}

void DriveFrames::take(const GuidedFrame& frame) {
    const Place place{frame.fix.x_grid() * frame.spacing_mm, frame.fix.y_grid() * frame.spacing_mm};
    if (images_.empty()) {
        first_ = place;
    } else if (distance_mm(newest_, place) < kStep_mm) {
        return;
    }
    newest_ = place;
    length_mm_ = distance_mm(first_, place);
    keep(frame.image);
}

bool DriveFrames::is_complete() const {
    constexpr std::size_t kMaxFrames = 80;
    return length_mm_ >= kWantedLength_mm || images_.size() >= kMaxFrames;
}

std::vector<video::Gauge> DriveFrames::gauges() const {
    return {{"drive", fmt::format("{:.0f} of {:.0f} mm", length_mm_, kWantedLength_mm),
             std::min(1.0, length_mm_ / kWantedLength_mm), is_complete()}};
}

std::string DriveFrames::advice() const {
    return images_.size() < 2 ? "drive straight ahead" : "go on straight ahead";
}

void ReadoutFrames::take(const GuidedFrame& frame) {
    if (is_complete_) return;
    const Seen now{frame.fix.x_grid(), frame.fix.y_grid(), frame.time_us, frame.index};
    if (!seen_.empty()) {
        const Seen& before = seen_.back();
        const bool is_next = now.index == before.index + 1 && now.time_us > before.time_us;
        const bool is_fast =
            std::hypot(now.x_grid - before.x_grid, now.y_grid - before.y_grid) >= kMinMotion;
        if (!is_next || !is_fast) {
            advice_ = is_next ? "drive faster" : "frames were dropped: close other programs";
            end_run();
            if (is_complete_) return;
        }
    }
    seen_.push_back(now);
    keep(frame.image);
    is_complete_ = images_.size() >= kWantedRun;
    if (seen_.size() > 1) advice_ = "go on at this speed";
}

/// Ends a sequence of consecutive frames. Completes the step if the sequence is long enough, and
/// discards the sequence otherwise.
void ReadoutFrames::end_run() {
    is_complete_ = is_complete_ || images_.size() >= kMinRun;
    if (is_complete_) return;
    images_.clear();
    seen_.clear();
}

std::vector<video::Gauge> ReadoutFrames::gauges() const {
    video::Gauge gauge = gauge_of("drive", images_.size(), kWantedRun, "frames");
    gauge.is_reached = is_complete_;
    return {gauge};
}

double ReadoutFrames::interval_ms() const {
    const auto steps = static_cast<double>(seen_.size() - 1);
    return static_cast<double>(seen_.back().time_us - seen_.front().time_us) / 1000 / steps;
}

/// Computes the tilt from the perspective distortion of the grid. The relative change of the image
/// scale per pixel is the tangent of the tilt divided by the focal length. The camera leans towards
/// the side of the view on which the paper is closer.
PenLean lean_in(const Fix& fix, double focal_px) {
    const FixedVec& perspective_q30 = fix.pattern_from_image.perspective_q30;
    const double u = std::ldexp(focal_px * perspective_q30.x, -30);
    const double v = std::ldexp(focal_px * perspective_q30.y, -30);
    const double c = std::cos(fix.theta_rad());
    const double s = std::sin(fix.theta_rad());
    return {c * u - s * v, s * u + c * v};
}

void PivotFrames::take(const GuidedFrame& frame) {
    const PenLean lean = lean_in(frame.fix, focal_px_);
    const auto is_near = [&lean](const PenLean& taken) {
        return std::hypot(lean.x - taken.x, lean.y - taken.y) < kMinLeanStep;
    };
    if (std::ranges::any_of(leans_, is_near)) return;
    leans_.push_back(lean);
    keep(frame.image);
}

std::array<bool, PivotFrames::kDirections> PivotFrames::directions() const {
    std::array<int, kDirections> counts{};
    for (const PenLean& lean : leans_) {
        if (degrees_of(lean) >= kMinLean_deg) ++counts[side_of(lean)];
    }
    std::array<bool, kDirections> seen{};
    std::ranges::transform(counts, seen.begin(), [](int count) { return count >= kMinLeans; });
    return seen;
}

double PivotFrames::max_tilt_deg() const {
    double tilt_deg = 0;
    for (const PenLean& lean : leans_)
        tilt_deg = std::max(tilt_deg, degrees_of(lean));
    return tilt_deg;
}

bool PivotFrames::is_complete() const {
    return leans_.size() >= kMaxPivots || (leans_.size() >= kWantedPivots && needs().empty());
}

std::vector<video::Gauge> PivotFrames::gauges() const {
    const auto seen = static_cast<std::size_t>(std::ranges::count(directions(), true));
    const double tilt_deg = max_tilt_deg();
    return {gauge_of("sides", seen, kDirections, "directions"),
            {"tilt", fmt::format("up to {:.0f} degrees", tilt_deg),
             std::min(1.0, tilt_deg / kWantedLean_deg), tilt_deg >= kWantedLean_deg},
            gauge_of("frames", leans_.size(), kWantedPivots, "frames")};
}

std::vector<std::string> PivotFrames::needs() const {
    std::vector<std::string> needs;
    if (max_tilt_deg() < kWantedLean_deg)
        needs.push_back(
            fmt::format("tilt the pen farther, to {:.0f} to 40 degrees", kWantedLean_deg));
    const std::array<bool, kDirections> seen = directions();
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (!seen[i])
            needs.push_back(fmt::format("tilt the pen towards the {} of the sheet", kSides[i]));
    }
    return needs;
}

std::string PivotFrames::advice() const {
    const std::vector<std::string> missing = needs();
    return missing.empty() ? "go on, with other tilts"
                           : missing.front() + "; the tip stays at its point";
}

}  // namespace dotpose::cli
