#include "page_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace dotpose::cli {
namespace {

/// Where the pixels lie on a page. Tilt and lens are left out: the place is known to some pixels.
class PixelsOnPage {
  public:
    PixelsOnPage(ImageView image, const Options& options, const Fix& fix, const SheetPlace& place)
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
    double u_;  ///< of the reference point
    double v_;
    double cosine_mm_ = 0;
    double sine_mm_ = 0;
};

/// As bright as half of the image: paper.
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

}  // namespace

std::optional<GreyImage> cut_to_page(ImageView image, const Options& options, const Fix& fix,
                                     const SheetPlace& place) {
    const PixelsOnPage page(image, options, fix, place);
    const int right = image.width_px - 1;
    const int bottom = image.height_px - 1;
    if (page.holds(0, 0) && page.holds(right, 0) && page.holds(0, bottom) &&
        page.holds(right, bottom)) {
        return std::nullopt;
    }
    const std::uint8_t paper = brightness_of(image);
    GreyImage cut{{}, image.width_px, image.height_px};
    cut.pixels.reserve(static_cast<std::size_t>(image.width_px) *
                       static_cast<std::size_t>(image.height_px));
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u)
            cut.pixels.push_back(page.holds(u, v) ? image.row(v)[u] : paper);
    }
    return cut;
}

}  // namespace dotpose::cli
