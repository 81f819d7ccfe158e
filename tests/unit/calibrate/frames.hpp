/// Simulated frames for the calibration tests. Each test chooses the poses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::calibrate_test {

inline constexpr double kDegree_rad = std::numbers::pi / 180;

/// Returns the camera used in the paper (section III-A.3): 188 x 120 px, with a distortion of 12 %
/// in the corner.
inline CameraModel paper_camera() {
    CameraModel camera;
    camera.k = -8.7e-6;
    return camera;
}

inline GreyImage nominal_frame(const CameraModel& camera, std::uint64_t seed, int index,
                               double tilt_x_deg = 0, double tilt_y_deg = 0) {
    Setup setup;
    setup.camera = camera;
    setup.seed = seed;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    shot.pose.tilt_x_rad = tilt_x_deg * kDegree_rad;
    shot.pose.tilt_y_rad = tilt_y_deg * kDegree_rad;
    return render(shot);
}

/// Returns the shot with its centre moved to a position in section (0, 0) of the pattern.
inline Shot moved_to(Shot shot, double x_mm, double y_mm, double theta_rad) {
    const double x = x_mm / kDefaultSpacing_mm;
    const double y = y_mm / kDefaultSpacing_mm;
    shot.pose.cell = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
    shot.pose.fraction_x = x - std::floor(x);
    shot.pose.fraction_y = y - std::floor(y);
    shot.pose.theta_rad = theta_rad;
    shot.page.pattern.section = {};
    return shot;
}

/// Returns the perfect calibration of a simulated camera that looks straight down.
inline Camera true_camera(const CameraModel& model) {
    Camera camera;
    camera.width_px = model.width_px;
    camera.height_px = model.height_px;
    camera.k_per_px2 = model.k;
    camera.centre_px = {(model.width_px - 1) / 2.0, (model.height_px - 1) / 2.0};
    camera.paper = PaperScale{model.mm_per_px, model.mm_per_px, 0, 0, 0};
    return camera;
}

// ---- A robot that carries the camera ----

/// Position of the image centre relative to the robot's centre, along the image axes.
inline constexpr Vec2 kCameraOnRobot_mm{-14.5, 6.25};

/// Returns a frame taken by a robot at a position. The image x axis points in the direction
/// `theta_rad`.
inline GreyImage robot_frame(const CameraModel& camera, std::uint64_t seed, int index, double x_mm,
                             double y_mm, double theta_rad) {
    Setup setup;
    setup.camera = camera;
    setup.seed = seed;
    const double c = std::cos(theta_rad);
    const double s = std::sin(theta_rad);
    const auto [x, y] = kCameraOnRobot_mm;
    return render(moved_to(draw_shot(setup, static_cast<std::uint64_t>(index)),
                           x_mm + c * x - s * y, y_mm + s * x + c * y, theta_rad));
}

/// Position at which the robot turns on the spot.
inline constexpr double kPivot_x_mm = 60'000;
inline constexpr double kPivot_y_mm = 45'000;

/// Mean position error along the axes of the robot, and mean heading error. The errors of single
/// fixes average out over the directions of the robot, so only the calibration error remains.
struct RobotError {
    Vec2 place_mm;
    double heading_rad = 0;
    int located = 0;
};
inline constexpr int kRobotStands = 24;
inline RobotError robot_error(const Camera& camera, const CameraModel& model, std::uint64_t seed) {
    Locator locator{DeviceOptions{}};
    constexpr double kStand_x_mm = kPivot_x_mm + 500;
    constexpr double kStand_y_mm = kPivot_y_mm + 300;
    RobotError sum;
    for (int i = 0; i < kRobotStands; ++i) {
        const double theta_rad = (360.0 / kRobotStands * i + 7) * kDegree_rad;
        const GreyImage image = robot_frame(model, seed, i, kStand_x_mm, kStand_y_mm, theta_rad);
        DeviceOptions options;
        use_camera(camera, image.width_px, image.height_px, options);
        locator.set_options(options);
        const Fix seen = locator.locate(image.view());
        const Fix fix = with_camera(seen, camera, locator.trace());
        if (fix.status != Status::ok) continue;
        const double dx = fix.x_mm() - kStand_x_mm;
        const double dy = fix.y_mm() - kStand_y_mm;
        const double c = std::cos(theta_rad);
        const double s = std::sin(theta_rad);
        sum.place_mm.x += c * dx + s * dy;
        sum.place_mm.y += c * dy - s * dx;
        sum.heading_rad += std::remainder(fix.theta_rad() - theta_rad, 2 * std::numbers::pi);
        ++sum.located;
    }
    return {{sum.place_mm.x / sum.located, sum.place_mm.y / sum.located},
            sum.heading_rad / sum.located,
            sum.located};
}

// ---- A table with four sheets ----

/// Number of dots per side of a sheet. There is a narrow margin between the pattern and the edge of
/// the sheet.
inline constexpr int kSide_cells = 120;
inline constexpr double kMargin_mm = 0.3;
inline constexpr double kPage_mm = (kSide_cells - 1) * kDefaultSpacing_mm + 2 * kMargin_mm;

/// Pose of a sheet on the table, in mm, with x to the right, y down, and clockwise angles.
struct Lying {
    double x_mm;
    double y_mm;
    double turn_rad;
    AxisScale print = {};
};
using Table = std::array<Lying, 4>;

/// A table with four sheets. The gaps between the sheets are 0 to 3 mm wide, and the sheets are
/// rotated by up to 1 degree.
inline const Table kTable = {Lying{0, 0, 0}, Lying{kPage_mm + 0.2, 0.4, 0.6 * kDegree_rad},
                             Lying{-0.3, kPage_mm + 1.4, -0.3 * kDegree_rad},
                             Lying{kPage_mm + 2.6, kPage_mm + 1.9, -1.0 * kDegree_rad}};

/// Returns the sheets, named a to d.
inline std::vector<SheetEntry> sheets_of_table() {
    std::vector<SheetEntry> entries;
    for (std::uint32_t i = 0; i < kTable.size(); ++i) {
        SheetEntry entry;
        entry.name = std::string(1, static_cast<char>('a' + i));
        entry.sheet.origin = {4096 + 2048 * i, 8192};
        entry.sheet.columns = entry.sheet.rows = kSide_cells;
        entry.sheet.width_mm = entry.sheet.height_mm = kPage_mm;
        entry.sheet.origin_x_mm = entry.sheet.origin_y_mm = kMargin_mm;
        entries.push_back(entry);
    }
    return entries;
}

inline CameraModel wide_camera() {
    CameraModel camera;
    camera.width_px = 376;
    camera.height_px = 240;
    camera.k = -2.2e-6;
    return camera;
}

/// Returns the camera's frame at a position on the table. Renders each sheet separately, and takes
/// the darkest value of each pixel.
inline GreyImage table_frame(const Table& table, const CameraModel& camera, std::uint64_t seed,
                             int index, double x_mm, double y_mm, double theta_rad) {
    Setup setup;
    setup.camera = camera;
    setup.seed = seed;
    GreyImage result;
    const std::vector<SheetEntry> entries = sheets_of_table();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Lying& lying = table[i];
        const double dx = x_mm - lying.x_mm;
        const double dy = y_mm - lying.y_mm;
        const double c = std::cos(lying.turn_rad);
        const double s = std::sin(lying.turn_rad);
        // If the camera is farther than this from the middle of a sheet, along either axis, it sees
        // none of the sheet's dots.
        constexpr double kTooFar_mm = kPage_mm / 2 + 12;
        if (std::abs(dx - kPage_mm / 2) > kTooFar_mm) continue;
        if (std::abs(dy - kPage_mm / 2) > kTooFar_mm) continue;
        const Sheet& sheet = entries[i].sheet;
        Shot shot = moved_to(
            draw_shot(setup, static_cast<std::uint64_t>(index)),
            (c * dx + s * dy - kMargin_mm) / lying.print.x + sheet.origin.x * kDefaultSpacing_mm,
            (c * dy - s * dx - kMargin_mm) / lying.print.y + sheet.origin.y * kDefaultSpacing_mm,
            theta_rad - lying.turn_rad);
        shot.page = page_of(sheet, seed + i + 1);
        shot.page.print_scale = lying.print;
        const GreyImage image = render(shot);
        // Each sheet is rendered with the same lighting and noise, so the darkest value of a pixel
        // is that of a dot if any sheet has a dot there.
        if (result.pixels.empty()) result = image;
        for (std::size_t k = 0; k < image.pixels.size(); ++k)
            result.pixels[k] = std::min(result.pixels[k], image.pixels[k]);
    }
    return result;
}

/// Returns frame `index` of a drive along the seams, with the camera at a random angle.
inline GreyImage seam_frame(const Table& table, const CameraModel& camera, std::uint64_t seed,
                            int index) {
    Rng rng(seed, static_cast<std::uint64_t>(index));
    const double along_mm = rng.uniform(5, 2 * kPage_mm - 5);
    const double across_mm = kPage_mm + rng.uniform(-1.5, 2.5);
    const double theta_rad = rng.uniform(-180, 180) * kDegree_rad;
    const bool is_level = index % 2 == 0;
    return table_frame(table, camera, seed, index, is_level ? along_mm : across_mm,
                       is_level ? across_mm : along_mm, theta_rad);
}

}  // namespace dotpose::calibrate_test
