#include "dotpose/tools/calibration_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose {
namespace {

/// Boundaries of the 3 x 3 regions of the image, in columns and rows of ImageCoverage. Advice to
/// the user refers to these regions by name.
constexpr std::array kRegionColumns = {0, 4, 8, ImageCoverage::kColumns};
constexpr std::array kRegionRows = {0, 3, 5, ImageCoverage::kRows};
constexpr std::size_t kRegions = 3;
constexpr const char* kRegionNames[kRegions][kRegions] = {
    {"upper left corner", "upper edge", "upper right corner"},
    {"left edge", "middle", "right edge"},
    {"lower left corner", "lower edge", "lower right corner"},
};

/// Returns the fraction of a region in which dots were seen.
double fraction_of(const ImageCoverage& image, std::size_t across, std::size_t down) {
    int parts = 0;
    int covered = 0;
    for (int row = kRegionRows[down]; row < kRegionRows[down + 1]; ++row) {
        for (int column = kRegionColumns[across]; column < kRegionColumns[across + 1]; ++column) {
            ++parts;
            covered += image.is_covered(column, row);
        }
    }
    return static_cast<double>(covered) / parts;
}

/// Returns the undistorted position of a pixel, relative to the undistorted position of the middle
/// of the image.
PixelPoint from_middle(const Camera& camera, PixelPoint pixel) {
    const PixelPoint middle =
        undistorted(camera, {(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0});
    const PixelPoint place = undistorted(camera, pixel);
    return {place.u - middle.u, place.v - middle.v};
}

}  // namespace

PixelPoint farthest_corner(const Camera& camera) {
    return {camera.centre_px.u < (camera.width_px - 1) / 2.0 ? camera.width_px - 1.0 : 0,
            camera.centre_px.v < (camera.height_px - 1) / 2.0 ? camera.height_px - 1.0 : 0};
}

double corner_sigma_px(const Camera& camera) {
    const PixelPoint corner = farthest_corner(camera);
    const PixelPoint place = from_middle(camera, corner);
    double variance = 0;
    const auto add_effect = [&](double Camera::*value, double PixelPoint::*of_centre,
                                const char* key) {
        Camera other = camera;
        double& changed = of_centre != nullptr ? other.centre_px.*of_centre : other.*value;
        // Finite-difference step, in standard deviations. It is small because undistortion is
        // nonlinear in the parameters.
        constexpr double kPart = 1e-3;
        changed += kPart * camera.sigma.at(key);
        const PixelPoint moved = from_middle(other, corner);
        variance += std::pow(std::hypot(moved.u - place.u, moved.v - place.v) / kPart, 2);
    };
    add_effect(&Camera::k_per_px2, nullptr, "k_per_px2");
    add_effect(nullptr, &PixelPoint::u, "centre_u_px");
    add_effect(nullptr, &PixelPoint::v, "centre_v_px");
    return std::sqrt(variance);
}

bool ImageCoverage::add(PixelPoint pixel) {
    const int column = static_cast<int>((pixel.u + 0.5) / width_px_ * kColumns);
    const int row = static_cast<int>((pixel.v + 0.5) / height_px_ * kRows);
    if (column < 0 || row < 0 || column >= kColumns || row >= kRows) return false;
    bool& covered = covered_[static_cast<std::size_t>(row * kColumns + column)];
    const bool is_new = !covered;
    covered = true;
    return is_new;
}

double ImageCoverage::fraction() const {
    return static_cast<double>(std::ranges::count(covered_, true)) /
           static_cast<double>(covered_.size());
}

CalibrationCoverage::CalibrationCoverage(int width_px, int height_px)
    : shorter_side_px_(std::min(width_px, height_px)), image_(width_px, height_px) {}

int CalibrationCoverage::parts_added_by(const CalibrationView& view) const {
    ImageCoverage with_it = image_;
    int added = 0;
    for (const PixelPoint& dot : view.dots)
        added += with_it.add(dot);
    return added;
}

void CalibrationCoverage::add(const CalibrationView& view) {
    ++frames_;
    for (const PixelPoint& dot : view.dots)
        image_.add(dot);
    constexpr double kShareOfView = 0.25;
    const double step_grid = kShareOfView * shorter_side_px_ / view.spacing_px;
    const bool is_known = std::ranges::any_of(places_, [&](const Place& place) {
        return place.section == view.section &&
               std::hypot(place.x_grid - view.x_grid, place.y_grid - view.y_grid) < step_grid;
    });
    if (!is_known) places_.push_back({view.x_grid, view.y_grid, view.section});
    const double turns = view.theta_rad / (2 * std::numbers::pi);
    const int direction = static_cast<int>((turns - std::floor(turns)) * kDirections);
    directions_[static_cast<std::size_t>(std::min(direction, kDirections - 1))] = true;
}

int CalibrationCoverage::directions() const {
    return static_cast<int>(std::ranges::count(directions_, true));
}

bool CalibrationCoverage::is_image_covered() const {
    constexpr double kMinCornerCoverage = 0.5;
    constexpr std::size_t kLast = kRegions - 1;
    return image_.fraction() >= kMinCoverage && fraction_of(image_, 0, 0) >= kMinCornerCoverage &&
           fraction_of(image_, kLast, 0) >= kMinCornerCoverage &&
           fraction_of(image_, 0, kLast) >= kMinCornerCoverage &&
           fraction_of(image_, kLast, kLast) >= kMinCornerCoverage;
}

std::string CalibrationCoverage::image_advice() const {
    std::size_t min_across = 0;
    std::size_t min_down = 0;
    for (std::size_t down = 0; down < kRegions; ++down) {
        for (std::size_t across = 0; across < kRegions; ++across) {
            if (fraction_of(image_, across, down) >= fraction_of(image_, min_across, min_down)) {
                continue;
            }
            min_across = across;
            min_down = down;
        }
    }
    return fmt::format("show dots in the {} of the image", kRegionNames[min_down][min_across]);
}

std::vector<CalibrationNeed> CalibrationCoverage::missing(const std::optional<Camera>& lens) const {
    using Kind = CalibrationNeed::Kind;
    std::vector<CalibrationNeed> needs;
    const auto need = [&needs](Kind kind, std::string advice) {
        needs.push_back({kind, std::move(advice)});
    };
    if (frames_ == 0) {
        need(Kind::frames, "hold the camera still over a printed sheet, in focus");
        return needs;
    }
    if (!is_image_covered()) need(Kind::image, image_advice());
    if (places() < kWantedPlaces) {
        need(Kind::places, fmt::format("move to other places of the sheet ({} of {} seen)",
                                       places(), kWantedPlaces));
    }
    if (directions() < kWantedDirections) {
        need(Kind::directions, fmt::format("turn the camera on the paper ({} of {} directions)",
                                           directions(), kWantedDirections));
    }
    if (frames_ < kWantedFrames) {
        need(Kind::frames, fmt::format("take more frames ({} of {})", frames_, kWantedFrames));
    } else if (!lens) {
        need(Kind::lens, "move to new places: the lens is not determined yet");
    } else if (const double sigma_px = corner_sigma_px(*lens); sigma_px > kWantedCornerSigma_px) {
        need(Kind::lens,
             fmt::format("move to new places (uncertainty in the corner {:.3f} px, required {:g})",
                         sigma_px, kWantedCornerSigma_px));
    }
    return needs;
}

}  // namespace dotpose
