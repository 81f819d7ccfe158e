#include "simulated_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dotpose::cli {
namespace {

constexpr double kMm_per_m = 1000;
constexpr double kExposure_s = 1e-4;
/// Number of steps into which one lap of the path is divided.
constexpr int kSteps = 4096;

/// Converts a point in the world to page coordinates, which are in mm from the top left corner of
/// the page, with y down.
Vec2 on_page(const SheetEntry& entry, Vec2 world_mm) {
    const WorldPose& pose = *entry.world;
    const double x = world_mm.x - pose.x_m * kMm_per_m;
    const double y = world_mm.y - pose.y_m * kMm_per_m;
    const double c = std::cos(pose.yaw_rad);
    const double s = std::sin(pose.yaw_rad);
    return {c * x + s * y, s * x - c * y};
}

Vec2 in_world(const SheetEntry& entry, Vec2 page_mm) {
    const WorldPose& pose = *entry.world;
    const double c = std::cos(pose.yaw_rad);
    const double s = std::sin(pose.yaw_rad);
    return {pose.x_m * kMm_per_m + c * page_mm.x + s * page_mm.y,
            pose.y_m * kMm_per_m + s * page_mm.x - c * page_mm.y};
}

/// Returns the distance between a point and the page in mm, or 0 if the point is on the page.
double distance_mm(const Sheet& sheet, Vec2 page_mm) {
    return std::hypot(std::max({-page_mm.x, page_mm.x - sheet.width_mm, 0.0}),
                      std::max({-page_mm.y, page_mm.y - sheet.height_mm, 0.0}));
}

/// Returns the offset of a point on the page from the first intersection, in spacings.
Vec2 from_origin(const SheetEntry& entry, Vec2 page_mm) {
    const Sheet& sheet = entry.sheet;
    return {(page_mm.x - sheet.origin_x_mm) / (sheet.pattern.spacing_mm * entry.print_scale_x),
            (page_mm.y - sheet.origin_y_mm) / (sheet.pattern.spacing_mm * entry.print_scale_y)};
}

PageArea page_area(const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    const Vec2 first = from_origin(entry, {0, 0});
    const Vec2 last = from_origin(entry, {sheet.width_mm, sheet.height_mm});
    return {sheet.origin.x + (first.x + last.x) / 2, sheet.origin.y + (first.y + last.y) / 2,
            (last.x - first.x) / 2, (last.y - first.y) / 2, 0};
}

/// Returns the radius, in mm on the paper, of the smallest circle around the image centre that
/// contains the whole image.
double reach_mm(const CameraModel& camera) {
    return std::hypot(camera.width_px, camera.height_px) / 2 * camera.mm_per_px;
}

}  // namespace

SimulatedDrive::SimulatedDrive(const std::vector<SheetEntry>& sheets, const DriveOptions& options,
                               const CameraModel& camera, const Imperfections& imperfections,
                               std::uint64_t seed)
    : options_(options), camera_(camera), imperfections_(imperfections), seed_(seed) {
    if (sheets.empty()) throw BadArgument("--drive needs a sheet file with a sheet to drive over");
    std::ranges::copy_if(sheets, std::back_inserter(sheets_),
                         [](const SheetEntry& entry) { return entry.world.has_value(); });
    if (sheets_.empty()) {
        sheets_.push_back(sheets.front());
        sheets_.front().world = WorldPose{};
    }
    // Sets the motion blur. The robot moves along the x axis of the image, so the scene moves along
    // -x.
    imperfections_.motion_px = {-options.speed_mm_s * kExposure_s / camera.mm_per_px, 0};
    lay_path();
}

void SimulatedDrive::lay_path() {
    constexpr double kMargin_mm = 5;
    // Minimum amplitude of the path along an axis, as a fraction of the side of the bounding
    // rectangle that is parallel to this axis.
    constexpr double kMinFraction = 0.25;
    Vec2 low{1e9, 1e9};
    Vec2 high{-1e9, -1e9};
    for (const SheetEntry& entry : sheets_) {
        for (const double x : {0.0, entry.sheet.width_mm}) {
            for (const double y : {0.0, entry.sheet.height_mm}) {
                const Vec2 corner = in_world(entry, {x, y});
                low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
                high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
            }
        }
    }
    const auto amplitude = [&](double length_mm) {
        return std::max(kMinFraction * length_mm, length_mm / 2 - reach_mm(camera_) - kMargin_mm);
    };
    centre_mm_ = {(low.x + high.x) / 2, (low.y + high.y) / 2};
    amplitude_mm_ = {amplitude(high.x - low.x), amplitude(high.y - low.y)};
    is_upright_ = amplitude_mm_.y > amplitude_mm_.x;
    lengths_mm_ = {0};
    Waypoint last = at_phase(0);
    for (int i = 1; i <= kSteps; ++i) {
        const Waypoint next = at_phase(2 * std::numbers::pi * i / kSteps);
        lengths_mm_.push_back(lengths_mm_.back() +
                              std::hypot(next.x_mm - last.x_mm, next.y_mm - last.y_mm));
        last = next;
    }
}

SimulatedDrive::Waypoint SimulatedDrive::at_phase(double phase_rad) const {
    const int x_turns = is_upright_ ? 2 : 1;
    const int y_turns = 3 - x_turns;
    const Vec2& reach = amplitude_mm_;
    return {centre_mm_.x + reach.x * std::sin(x_turns * phase_rad),
            centre_mm_.y + reach.y * std::sin(y_turns * phase_rad),
            std::atan2(reach.y * y_turns * std::cos(y_turns * phase_rad),
                       reach.x * x_turns * std::cos(x_turns * phase_rad))};
}

SimulatedDrive::Waypoint SimulatedDrive::waypoint(int frame) const {
    const double driven_mm =
        std::fmod(frame * options_.speed_mm_s / options_.fps, lengths_mm_.back());
    const auto after = std::ranges::upper_bound(lengths_mm_, driven_mm);
    const auto step = static_cast<double>(after - lengths_mm_.begin() - 1);
    const double part = (driven_mm - after[-1]) / (after[0] - after[-1]);
    return at_phase(2 * std::numbers::pi * (step + part) / kSteps);
}

int SimulatedDrive::frames_per_lap() const {
    return std::max(1, static_cast<int>(lengths_mm_.back() / options_.speed_mm_s * options_.fps));
}

PoseOnSheet SimulatedDrive::pose(int frame) const {
    const Waypoint now = waypoint(frame);
    const Vec2 place{now.x_mm, now.y_mm};
    const auto nearest = std::ranges::min_element(sheets_, {}, [&](const SheetEntry& entry) {
        return distance_mm(entry.sheet, on_page(entry, place));
    });
    const Vec2 page_mm = on_page(*nearest, place);
    const Vec2 offset = from_origin(*nearest, page_mm);
    PoseOnSheet found{&*nearest, {}, distance_mm(nearest->sheet, page_mm) == 0};
    found.pose.cell = nearest->sheet.origin;
    found.pose.fraction_x = offset.x;
    found.pose.fraction_y = offset.y;
    found.pose.theta_rad =
        std::remainder(nearest->world->yaw_rad - now.heading_rad, 2 * std::numbers::pi);
    return found;
}

GreyImage SimulatedDrive::view(const SheetEntry& entry, const CameraPose& pose, int frame) const {
    Page page = page_of(entry.sheet, seed_);
    page.print_scale = entry.print_scale();
    page.paper = page_area(entry);
    Rng rng(seed_, static_cast<std::uint64_t>(frame));
    return render(page, camera_, pose, imperfections_, rng.bits());
}

GreyImage SimulatedDrive::image(int frame) const {
    const Waypoint now = waypoint(frame);
    const PoseOnSheet main = pose(frame);
    GreyImage image = view(*main.entry, main.pose, frame);
    const Projection projection(camera_, main.pose);
    const Vec2 centre = on_page(*main.entry, {now.x_mm, now.y_mm});
    for (const SheetEntry& entry : sheets_) {
        const Vec2 place = on_page(entry, {now.x_mm, now.y_mm});
        if (&entry == main.entry || distance_mm(entry.sheet, place) > reach_mm(camera_)) continue;
        // Pixels that show another page are copied from a view of that page.
        const Vec2 offset = from_origin(entry, place);
        CameraPose its_pose = main.pose;
        its_pose.cell = entry.sheet.origin;
        its_pose.fraction_x = offset.x;
        its_pose.fraction_y = offset.y;
        its_pose.theta_rad = entry.world->yaw_rad - now.heading_rad;
        const GreyImage other = view(entry, its_pose, frame);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const auto width = static_cast<std::size_t>(image.width_px);
            const Vec2 seen = projection.offset_from_pixel(
                {static_cast<double>(i % width), static_cast<double>(i / width)});
            const Vec2 on_main{centre.x + seen.x, centre.y + seen.y};
            const Vec2 on_other = on_page(entry, in_world(*main.entry, on_main));
            if (distance_mm(main.entry->sheet, on_main) > 0 &&
                distance_mm(entry.sheet, on_other) == 0) {
                image.pixels[i] = other.pixels[i];
            }
        }
    }
    return image;
}

}  // namespace dotpose::cli
