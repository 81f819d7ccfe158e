/// A simulated robot that drives a figure of eight over two sheets, rests, is lifted twice, and
/// crosses printed graphics. Provides the camera frames and the true poses. The world frame is in
/// mm, with y up.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/print.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::test {

inline constexpr double kDriveFps = 200;
/// x coordinate of the seam between two adjacent A3 pages. The seam is in the middle of the path.
inline constexpr double kSeam_mm = 420;

struct DriveState {
    double x_mm = 0;
    double y_mm = 0;
    double yaw_rad = 0;  ///< angle of the image x axis, which points in the driving direction
    double vx_mm_s = 0;
    double vy_mm_s = 0;
    double turn_rad_s = 0;
    bool is_lifted = false;
    bool has_graphics = false;
};

/// Times of the events during the drive, in s. Each event coincides with a frame.
struct DrivePlan {
    double start = 0.8;  ///< end of the first rest
    double lift = 2.0;
    double put_down = 2.3;  ///< the robot is put down at the other end of the path
    double graphics = 2.6;
    double graphics_end = 3.0;
    double second_lift = 3.4;
    double second_put_down = 3.55;  ///< the robot is put down a little to the side
    double stop = 4.5;              ///< end of the deceleration, beginning of the final rest
    double end = 5.5;
    /// Maximum speed, reached in the middle of the path. It is 0 for a robot that does not move.
    double speed_mm_s = 300;
};

class Drive {
  public:
    explicit Drive(const DrivePlan& plan = {}) : plan_(plan) {}

    int frames() const { return static_cast<int>(std::lround(plan_.end * kDriveFps)); }
    const DrivePlan& plan() const { return plan_; }

    DriveState at(int frame) const {
        const double t = frame / kDriveFps;
        const double p = phase(t);
        const double w = rate(t);
        DriveState s;
        s.x_mm = kSeam_mm + 300 * std::sin(p) + (t >= plan_.second_put_down ? 3 : 0);
        s.y_mm = 148.5 + 100 * std::sin(2 * p);
        const double dx = 300 * std::cos(p);
        const double dy = 200 * std::cos(2 * p);
        const double ddx = -300 * std::sin(p);
        const double ddy = -400 * std::sin(2 * p);
        s.yaw_rad = std::atan2(dy, dx);
        s.vx_mm_s = dx * w;
        s.vy_mm_s = dy * w;
        s.turn_rad_s = (dx * ddy - dy * ddx) / (dx * dx + dy * dy) * w;
        s.is_lifted = (t >= plan_.lift && t < plan_.put_down) ||
                      (t >= plan_.second_lift && t < plan_.second_put_down);
        s.has_graphics = t >= plan_.graphics && t < plan_.graphics_end;
        return s;
    }

  private:
    static constexpr double kRamp = 0.4;  ///< duration of each acceleration and deceleration, in s

    /// Returns the integral of a ramp from 0 to 1 that begins at t = 0 and is smooth at both ends.
    static double ramp_integral(double t) {
        const double u = std::clamp(t / kRamp, 0.0, 1.0);
        return kRamp * (u * u * u - u * u * u * u / 2) + std::max(t - kRamp, 0.0);
    }
    static double ramp(double t) {
        const double u = std::clamp(t / kRamp, 0.0, 1.0);
        return u * u * (3 - 2 * u);
    }
    /// Returns the rate at which the phase of the path changes at full speed, in rad/s.
    double full_rate() const { return plan_.speed_mm_s / std::hypot(300, 200); }
    double phase(double t) const {
        const double driven =
            ramp_integral(t - plan_.start) - ramp_integral(t - plan_.stop + kRamp);
        return -0.6 + full_rate() * driven + (t >= plan_.put_down ? std::numbers::pi : 0);
    }
    double rate(double t) const {
        return full_rate() * (ramp(t - plan_.start) - ramp(t - plan_.stop + kRamp));
    }

    DrivePlan plan_;
};

inline std::vector<SheetEntry> drive_sheets() {
    std::vector<SheetEntry> sheets;
    for (int i = 0; i < 2; ++i) {
        SheetOptions options;
        options.paper = {420, 297};
        options.margin_mm = 0;
        options.origin = {2000 + 8000 * static_cast<std::uint32_t>(i), 3000};
        SheetEntry entry;
        entry.name = i == 0 ? "left" : "right";
        entry.sheet = make_sheet(options);
        entry.world = WorldPose{i * kSeam_mm / 1000, 0.297, 0};
        sheets.push_back(entry);
    }
    return sheets;
}

inline void save_drive_sheets(const std::filesystem::path& path) {
    SheetFile sheets(path);
    for (const SheetEntry& entry : drive_sheets())
        sheets.add(entry);
    sheets.save();
}

class DriveCamera {
  public:
    DriveCamera(int width_px, int height_px) : DriveCamera(width_px, height_px, nominal()) {}
    DriveCamera(int width_px, int height_px, const Imperfections& imperfections)
        : sheets_(drive_sheets()), base_(imperfections) {
        camera_.width_px = width_px;
        camera_.height_px = height_px;
    }

    /// Sets the displacement of the dots on both sheets, as a function of the intersection
    /// (Page::shift_mm).
    void set_shift(std::function<Vec2(Vec2 place_grid)> shift_mm) {
        shift_mm_ = std::move(shift_mm);
    }

    static Imperfections nominal() {
        Rng rng(2024);
        return draw_imperfections(Preset::nominal, rng);
    }

    const CameraModel& camera() const { return camera_; }

    GreyImage frame(const Drive& drive, int index) const {
        return frame(drive.at(index), static_cast<std::uint64_t>(index) + 1);
    }
    /// Returns the frame that the camera takes in a given state of the robot. `seed` determines the
    /// noise.
    GreyImage frame(const DriveState& state, std::uint64_t seed) const {
        if (state.is_lifted) return empty(seed);
        const double reach_mm = camera_.mm_per_px * camera_.width_px;
        if (std::abs(state.x_mm - kSeam_mm) > reach_mm) {
            return view_of(state.x_mm < kSeam_mm ? 0 : 1, state, seed);
        }
        // Near the seam, each pixel shows the sheet that is on its side of the seam.
        GreyImage image = view_of(0, state, seed);
        const GreyImage right = view_of(1, state, seed);
        const Projection projection(camera_, pose_on(0, state));
        for (int v = 0; v < image.height_px; ++v) {
            for (int u = 0; u < image.width_px; ++u) {
                const Vec2 offset =
                    projection.offset_from_pixel({static_cast<double>(u), static_cast<double>(v)});
                const auto i = static_cast<std::size_t>(v * image.width_px + u);
                if (state.x_mm + offset.x > kSeam_mm) image.pixels[i] = right.pixels[i];
            }
        }
        return image;
    }

  private:
    /// Returns the pose on a sheet. The x axes of the sheets are parallel to the x axis of the
    /// world.
    CameraPose pose_on(std::size_t sheet_index, const DriveState& state) const {
        const Sheet& sheet = sheets_[sheet_index].sheet;
        const double x_sheet_mm = state.x_mm - kSeam_mm * static_cast<double>(sheet_index);
        const double y_sheet_mm = 297 - state.y_mm;
        const double x =
            sheet.origin.x + (x_sheet_mm - sheet.origin_x_mm) / sheet.pattern.spacing_mm;
        const double y =
            sheet.origin.y + (y_sheet_mm - sheet.origin_y_mm) / sheet.pattern.spacing_mm;
        CameraPose pose;
        pose.cell = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
        pose.fraction_x = x - std::floor(x);
        pose.fraction_y = y - std::floor(y);
        pose.theta_rad = -state.yaw_rad;
        return pose;
    }

    GreyImage view_of(std::size_t sheet_index, const DriveState& state, std::uint64_t seed) const {
        constexpr double kExposure_s = 5e-5;
        Imperfections imperfections = base_;
        // The robot drives along the x axis of the image, so the scene moves in the opposite
        // direction.
        const double speed_mm_s = std::hypot(state.vx_mm_s, state.vy_mm_s);
        imperfections.motion_px = {-speed_mm_s * kExposure_s / camera_.mm_per_px, 0};
        imperfections.graphics = state.has_graphics ? 2 : 0;
        Page page = page_of(sheets_[sheet_index].sheet);
        page.shift_mm = shift_mm_;
        return render(page, camera_, pose_on(sheet_index, state), imperfections, seed);
    }

    /// Returns a frame taken while the robot is lifted. The frame is out of focus and shows no
    /// dots.
    GreyImage empty(std::uint64_t seed) const {
        GreyImage image{{}, camera_.width_px, camera_.height_px};
        Rng rng(seed);
        for (int i = 0; i < camera_.width_px * camera_.height_px; ++i)
            image.pixels.push_back(static_cast<std::uint8_t>(120.0 + 2 * rng.normal()));
        return image;
    }

    std::vector<SheetEntry> sheets_;
    CameraModel camera_;
    Imperfections base_;
    std::function<Vec2(Vec2 place_grid)> shift_mm_;
};

}  // namespace dotpose::test
