/// Errors in the readings from a simulated drive, relative to the true poses.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "drive.hpp"

namespace dotpose::test {

struct DrivePose {
    double x_mm = 0;
    double y_mm = 0;
    double yaw_rad = 0;
};

struct DriveReading {
    bool has_fix = false;
    DrivePose raw;
    bool is_accepted = false;
    std::string events;
    DrivePose filtered;
    double vx_mm_s = 0;
    double vy_mm_s = 0;
    double turn_rad_s = 0;
};

/// Errors in position (per axis), heading and velocity. A new filter needs some frames to estimate
/// the velocity, so the rms errors exclude the frame of each `fix` event and the next two frames.
class DriveErrors {
  public:
    void add(const DriveState& truth, const DriveReading& reading) {
        const bool begins = reading.events.find("fix") != std::string::npos;
        settling_ = begins ? 0 : settling_ + 1;
        if (!reading.has_fix) return;
        ++fixes_;
        const DrivePose raw = difference(reading.raw, truth);
        if (std::hypot(raw.x_mm, raw.y_mm) > 0.1 || std::abs(raw.yaw_rad) > 0.02 ||
            truth.is_lifted) {
            ++wrong_;
        }
        if (!reading.is_accepted || settling_ < 3) return;
        const DrivePose filtered = difference(reading.filtered, truth);
        ++settled_;
        raw_mm2_ += (squared(raw.x_mm) + squared(raw.y_mm)) / 2;
        filtered_mm2_ += (squared(filtered.x_mm) + squared(filtered.y_mm)) / 2;
        raw_rad2_ += squared(raw.yaw_rad);
        filtered_rad2_ += squared(filtered.yaw_rad);
        velocity_ +=
            squared(reading.vx_mm_s - truth.vx_mm_s) + squared(reading.vy_mm_s - truth.vy_mm_s);
        turn_ += squared(reading.turn_rad_s - truth.turn_rad_s);
    }

    int fixes() const { return fixes_; }
    int wrong() const { return wrong_; }
    /// Root mean square errors, in the units given by the function names.
    double raw_um() const { return 1000 * root_mean(raw_mm2_); }
    double filtered_um() const { return 1000 * root_mean(filtered_mm2_); }
    double raw_deg() const { return degrees(root_mean(raw_rad2_)); }
    double filtered_deg() const { return degrees(root_mean(filtered_rad2_)); }
    double velocity_mm_s() const { return root_mean(velocity_); }
    double turn_deg_s() const { return degrees(root_mean(turn_)); }

    static DrivePose difference(const DrivePose& pose, const DriveState& truth) {
        return {pose.x_mm - truth.x_mm, pose.y_mm - truth.y_mm,
                std::remainder(pose.yaw_rad - truth.yaw_rad, 2 * std::numbers::pi)};
    }

  private:
    static double squared(double value) { return value * value; }
    static double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }
    double root_mean(double sum) const { return std::sqrt(sum / settled_); }

    int settling_ = 0;  ///< number of frames since the last `fix` event
    int fixes_ = 0;
    int wrong_ = 0;
    int settled_ = 0;
    double raw_mm2_ = 0;
    double filtered_mm2_ = 0;
    double raw_rad2_ = 0;
    double filtered_rad2_ = 0;
    double velocity_ = 0;
    double turn_ = 0;
};

}  // namespace dotpose::test
