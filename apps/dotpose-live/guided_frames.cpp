#include "guided_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "image_copy.hpp"

namespace dotpose::cli {
namespace {

/// Distance between two frames of a straight drive. A drive of kWantedLength_mm has 40 frames.
constexpr double kStep_mm = 1.5;
/// Length of a straight drive. With residuals of 0.01 mm, this length determines the direction to
/// 0.01 degrees.
constexpr double kWantedLength_mm = 60;
/// Number of consecutive frames of a fast drive.
constexpr std::size_t kWantedRun = 40;
/// Minimum number of consecutive frames if the run ends early.
constexpr std::size_t kMinRun = 15;
/// Minimum motion between two frames of a fast drive, in spacings.
constexpr double kMinMotion = 0.5;

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

video::Gauge SpinFrames::gauge() const {
    const double share = static_cast<double>(images_.size()) / kDirections;
    return {"turn", fmt::format("{} of {} directions", images_.size(), kDirections), share,
            is_complete()};
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

video::Gauge DriveFrames::gauge() const {
    return {"drive", fmt::format("{:.0f} of {:.0f} mm", length_mm_, kWantedLength_mm),
            std::min(1.0, length_mm_ / kWantedLength_mm), is_complete()};
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

/// Completes the calibration if there are enough consecutive frames, otherwise starts again.
void ReadoutFrames::end_run() {
    is_complete_ = is_complete_ || images_.size() >= kMinRun;
    if (is_complete_) return;
    images_.clear();
    seen_.clear();
}

video::Gauge ReadoutFrames::gauge() const {
    return {"drive", fmt::format("{} of {} frames", images_.size(), kWantedRun),
            static_cast<double>(images_.size()) / static_cast<double>(kWantedRun), is_complete_};
}

double ReadoutFrames::interval_ms() const {
    const auto steps = static_cast<double>(seen_.size() - 1);
    return static_cast<double>(seen_.back().time_us - seen_.front().time_us) / 1000 / steps;
}

}  // namespace dotpose::cli
