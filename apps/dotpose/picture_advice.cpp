#include "picture_advice.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <fmt/core.h>

#include "dotpose/grey_image.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::cli {
namespace {

/// The grey level that a tenth of the image exceeds: that of paper, where there is any.
int paper_level(ImageView image) {
    std::array<std::int64_t, 256> counts{};
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u)
            ++counts[image.row(v)[u]];
    }
    std::int64_t left = std::int64_t{image.width_px} * image.height_px / 10;
    int level = 255;
    while (level > 0 && left >= counts[static_cast<std::size_t>(level)])
        left -= counts[static_cast<std::size_t>(level--)];
    return level;
}

/// The middle of an image, at most `side_px` wide and high, enlarged with straight lines between
/// its pixels.
GreyImage enlarged_middle(ImageView image, int side_px, int by) {
    const int width_px = std::min(image.width_px, side_px) - 1;
    const int height_px = std::min(image.height_px, side_px) - 1;
    const int left = (image.width_px - 1 - width_px) / 2;
    const int top = (image.height_px - 1 - height_px) / 2;
    GreyImage result{{}, width_px * by, height_px * by};
    for (int v = 0; v < result.height_px; ++v) {
        const std::uint8_t* upper = image.row(top + v / by) + left;
        const std::uint8_t* lower = image.row(top + v / by + 1) + left;
        const int down = v % by;
        for (int u = 0; u < result.width_px; ++u) {
            const int right = u % by;
            const auto along = [&](const std::uint8_t* row) {
                return row[u / by] * (by - right) + row[u / by + 1] * right;
            };
            const int sum = along(upper) * (by - down) + along(lower) * down;
            result.pixels.push_back(static_cast<std::uint8_t>((sum + by * by / 2) / (by * by)));
        }
    }
    return result;
}

/// The spacing in the image, if the pattern can be read once the image is enlarged.
std::optional<double> too_small_spacing_px(ImageView image, const Options& options,
                                           Workspace& scratch) {
    constexpr int kMiddle_px = 320;
    constexpr double kLeastSpacing_px = 6;
    Options once;
    once.profile = options.profile;
    once.effort = Effort::once;
    for (const int by : {2, 3}) {
        const GreyImage large = enlarged_middle(image, kMiddle_px, by);
        const Fix fix = locate(large.view(), once, scratch);
        if (fix.status != Status::ok) continue;
        const double spacing_px = fix.spacing_px() / by;
        if (spacing_px < kLeastSpacing_px) return spacing_px;
    }
    return std::nullopt;
}

}  // namespace

std::string advice_on(ImageView image, Status status, const Options& options, Workspace& scratch) {
    // Dots that blur spreads to a quarter of their contrast have to differ by min_contrast.
    const int darkest_paper = 4 * options.threshold.min_contrast;
    if (const int level = paper_level(image); level < darkest_paper) {
        return fmt::format(
            "the picture is too dark, its paper has grey level {} of 255: more light, "
            "or a longer exposure, helps",
            level);
    }
    if (const auto spacing_px = too_small_spacing_px(image, options, scratch)) {
        return fmt::format(
            "the picture is too coarse, its dots are {:.1f} px apart and at least 6 "
            "are needed: come closer, or take more pixels",
            *spacing_px);
    }
    if (status != Status::no_grid) return {};
    return "a sheet that is out of focus, too far away (under 6 px from dot to dot) or strongly "
           "tilted looks so: focus, come closer, and look straight down";
}

}  // namespace dotpose::cli
