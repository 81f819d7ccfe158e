#include "follow/page_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "dotpose/files/camera.hpp"

namespace dotpose::follow_detail {
namespace {

/// Tests whether a pixel is on the page. The test ignores tilt and lens distortion, so it can be
/// wrong by a few pixels.
class PixelsOnPage {
  public:
    PixelsOnPage(ImageView image, const DeviceOptions& options, const Fix& fix,
                 const SheetPlace& place)
        : place_(place),
          u_((image.width_px - 1) / 2.0 + options.reference_dx_q8 / 256.0),
          v_((image.height_px - 1) / 2.0 + options.reference_dy_q8 / 256.0) {
        const double mm_per_px = place.entry->sheet.pattern.spacing_mm / fix.spacing_px();
        cosine_mm_ = mm_per_px * std::cos(place.theta_rad);
        sine_mm_ = mm_per_px * std::sin(place.theta_rad);
    }

    bool holds(int u, int v) const {
        const Sheet& sheet = place_.entry->sheet;
        const double x_mm = place_.x_mm + cosine_mm_ * (u - u_) - sine_mm_ * (v - v_);
        const double y_mm = place_.y_mm + sine_mm_ * (u - u_) + cosine_mm_ * (v - v_);
        return x_mm >= 0 && x_mm <= sheet.width_mm && y_mm >= 0 && y_mm <= sheet.height_mm;
    }

  private:
    const SheetPlace& place_;
    double u_;  ///< reference point in the image, in px
    double v_;
    double cosine_mm_ = 0;
    double sine_mm_ = 0;
};

/// Estimates the grey level of the paper as the median of the image.
std::uint8_t brightness_of(ImageView image) {
    std::array<std::int64_t, 256> counts{};
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u)
            ++counts[image.row(v)[u]];
    }
    std::int64_t left = std::int64_t{image.width_px} * image.height_px / 2;
    std::size_t grey = 0;
    while (left >= counts[grey])
        left -= counts[grey++];
    return static_cast<std::uint8_t>(grey);
}

/// Returns a copy of the image in which all pixels outside `region` have the grey level of the
/// paper. Returns an empty optional if nothing needs to be masked, that is, if all corners of the
/// image are inside `region`.
template <typename Region>
std::optional<GreyImage> cut_to(ImageView image, const Region& region) {
    const int right = image.width_px - 1;
    const int bottom = image.height_px - 1;
    if (region.holds(0, 0) && region.holds(right, 0) && region.holds(0, bottom) &&
        region.holds(right, bottom)) {
        return std::nullopt;
    }
    const std::uint8_t paper = brightness_of(image);
    GreyImage cut{{}, image.width_px, image.height_px};
    cut.pixels.reserve(static_cast<std::size_t>(image.width_px) *
                       static_cast<std::size_t>(image.height_px));
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u)
            cut.pixels.push_back(region.holds(u, v) ? image.row(v)[u] : paper);
    }
    return cut;
}

/// Tests whether a pixel is in the dot area of a sheet, using the map of the fix.
class PixelsAmongDots {
  public:
    PixelsAmongDots(ImageView image, const DeviceOptions& options, const Fix& fix,
                    const Sheet& sheet)
        : plane_(fix.pattern_from_image),
          left_(cells(fix.place.cell.x, sheet.origin.x)),
          top_(cells(fix.place.cell.y, sheet.origin.y)),
          columns_(sheet.columns),
          rows_(sheet.rows) {
        camera_.k_per_px2 = options.lens.k_q40 * 0x1p-40;
        camera_.centre_px = {(image.width_px - 1) / 2.0 + options.lens.centre_dx_q8 / 256.0,
                             (image.height_px - 1) / 2.0 + options.lens.centre_dy_q8 / 256.0};
    }

    bool holds(int u, int v) const {
        const PixelPoint seen = undistorted(camera_, {double(u), double(v)});
        const double du = seen.u - plane_.centre_q8.x / 256.0;
        const double dv = seen.v - plane_.centre_q8.y / 256.0;
        const double divisor =
            1 + (plane_.perspective_q30.x * du + plane_.perspective_q30.y * dv) * 0x1p-30 +
            plane_.lens_q40 * 0x1p-40 * (du * du + dv * dv);
        const auto from_first_dot = [&](std::int32_t at_q16, std::int32_t du_q24,
                                        std::int32_t dv_q24, double first) {
            return at_q16 / 65536.0 + (du_q24 * du + dv_q24 * dv) * 0x1p-24 / divisor - first;
        };
        const double x =
            from_first_dot(plane_.at_centre_q16.x, plane_.du_q24.x, plane_.dv_q24.x, left_);
        const double y =
            from_first_dot(plane_.at_centre_q16.y, plane_.du_q24.y, plane_.dv_q24.y, top_);
        return x >= 0 && x < columns_ && y >= 0 && y < rows_;
    }

  private:
    /// Returns the signed distance, in cells, from cell `from` to the edge of the region whose
    /// first cell is `first`. The edge is half a cell before `first`. The plane is cyclic, and the
    /// distance is measured in the shorter direction.
    static double cells(std::uint32_t from, std::uint32_t first) {
        return std::remainder(double(first) - double(from), kPositionsPerAxis) - 0.5;
    }

    Camera camera_;
    PlaneFromImage plane_;
    double left_;
    double top_;
    int columns_;
    int rows_;
};

}  // namespace

std::optional<GreyImage> cut_to_page(ImageView image, const DeviceOptions& options, const Fix& fix,
                                     const SheetPlace& place) {
    return cut_to(image, PixelsOnPage(image, options, fix, place));
}

std::optional<GreyImage> cut_to_dots(ImageView image, const DeviceOptions& options, const Fix& fix,
                                     const Sheet& sheet) {
    return cut_to(image, PixelsAmongDots(image, options, fix, sheet));
}

}  // namespace dotpose::follow_detail
