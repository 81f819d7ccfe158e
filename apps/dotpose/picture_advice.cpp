#include "picture_advice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>

#include <fmt/core.h>

#include "dotpose/files/camera.hpp"
#include "dotpose/files/code_names.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "fields.hpp"

namespace dotpose::cli {
namespace {

/// Returns the 90th percentile of the grey levels. This percentile approximates the grey level of
/// the paper if the paper covers more than a tenth of the image and is the brightest object in it.
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

/// Resamples an image to `width_px` x `height_px` with bilinear interpolation. `in_image(u, v)`
/// maps pixel (u, v) of the result to a point in the original image. Points outside the image are
/// clamped to its border.
template <typename InImage>
GreyImage resampled(const ImageView& image, int width_px, int height_px, InImage in_image) {
    GreyImage result{{}, width_px, height_px};
    for (int k = 0; k < width_px * height_px; ++k) {
        const PixelPoint at = in_image(k % width_px, k / width_px);
        const double u = std::clamp(at.u, 0.0, image.width_px - 1.001);
        const double v = std::clamp(at.v, 0.0, image.height_px - 1.001);
        const std::uint8_t* upper = image.row(static_cast<int>(v)) + static_cast<int>(u);
        const std::uint8_t* lower = upper + image.stride_bytes;
        const double right = u - std::floor(u);
        const double down = v - std::floor(v);
        const double level = (upper[0] * (1 - right) + upper[1] * right) * (1 - down) +
                             (lower[0] * (1 - right) + lower[1] * right) * down;
        result.pixels.push_back(static_cast<std::uint8_t>(std::lround(level)));
    }
    return result;
}

/// Returns the central part of an image, at most `side_px` wide and high, enlarged by a factor of
/// `by`.
GreyImage enlarged_middle(const ImageView& image, int side_px, int by) {
    const int width_px = std::min(image.width_px, side_px) - 1;
    const int height_px = std::min(image.height_px, side_px) - 1;
    const int left = (image.width_px - 1 - width_px) / 2;
    const int top = (image.height_px - 1 - height_px) / 2;
    return resampled(image, width_px * by, height_px * by, [&](int u, int v) {
        const double pixel = by;
        return PixelPoint{left + u / pixel, top + v / pixel};
    });
}

/// Returns the spacing of the dots in px if the pattern can be read only in an enlarged image, and
/// none otherwise.
std::optional<double> too_small_spacing_px(ImageView image, const DeviceOptions& options,
                                           LargeMemory& scratch) {
    constexpr int kMiddle_px = 320;
    constexpr double kMinSpacing_px = 6;
    DeviceOptions once;
    once.code = options.code;
    once.effort = Effort::once;
    for (const int by : {2, 3, 4}) {
        const GreyImage large = enlarged_middle(image, kMiddle_px, by);
        const Fix fix = Locator(scratch, once).locate(large.view());
        if (fix.status != Status::ok) continue;
        const double spacing_px = fix.spacing_px() / by;
        if (spacing_px < kMinSpacing_px) return spacing_px;
    }
    return std::nullopt;
}

/// Stretches an image along one direction by a factor of `by`, to compensate for the foreshortening
/// of a tilted sheet.
struct Stretch {
    double angle_rad = 0;
    double by = 1;

    /// Converts an offset from the centre of the stretched image to an offset from the centre of
    /// the original image, both in px.
    PixelPoint in_image(PixelPoint step) const {
        const double c = std::cos(angle_rad);
        const double s = std::sin(angle_rad);
        const double shrink = (c * step.u + s * step.v) * (1 / by - 1);
        return {step.u + shrink * c, step.v + shrink * s};
    }
};

/// Returns the central part of the stretched image, a square with sides of at most `side_px`. The
/// corners of the square may be outside the original image.
GreyImage stretched_middle(const ImageView& image, int side_px, const Stretch& stretch) {
    const int side = std::min({image.width_px, image.height_px, side_px});
    return resampled(image, side, side, [&](int u, int v) {
        const PixelPoint step = stretch.in_image({u - 0.5 * (side - 1), v - 0.5 * (side - 1)});
        return PixelPoint{0.5 * (image.width_px - 1) + step.u,
                          0.5 * (image.height_px - 1) + step.v};
    });
}

/// Returns the tilt of the sheet in degrees if the pattern can be read only in a stretched image,
/// and none otherwise.
std::optional<double> large_tilt_degrees(ImageView image, const DeviceOptions& options,
                                         LargeMemory& scratch) {
    constexpr int kMiddle_px = 480;
    constexpr int kDirections = 8;
    DeviceOptions once;
    once.code = options.code;
    once.effort = Effort::once;
    for (const double by : {2.0, 3.0}) {
        for (int k = 0; k < kDirections; ++k) {
            const Stretch stretch{k * std::numbers::pi / kDirections, by};
            const GreyImage straight = stretched_middle(image, kMiddle_px, stretch);
            const Fix fix = Locator(scratch, once).locate(straight.view());
            if (fix.status != Status::ok) continue;
            // Maps an offset in the original image, in px, to an offset in cells. Applies the
            // stretch, then the fitted plane.
            const double c = std::cos(stretch.angle_rad);
            const double s = std::sin(stretch.angle_rad);
            const PlaneFromImage& plane = fix.pattern_from_image;
            const auto seen = [&](double u, double v) {
                const double more = (c * u + s * v) * (by - 1);
                const double x = u + more * c;
                const double y = v + more * s;
                return std::array{plane.du_q24.x * x + plane.dv_q24.x * y,
                                  plane.du_q24.y * x + plane.dv_q24.y * y};
            };
            const auto a = seen(1, 0);
            const auto b = seen(0, 1);
            // The singular values of the matrix (a b) are the dimensions, in cells, of the area
            // that one pixel covers on the paper: along the direction of the tilt and perpendicular
            // to it. The ratio of the smaller to the larger dimension is the cosine of the tilt.
            const double sum = a[0] * a[0] + a[1] * a[1] + b[0] * b[0] + b[1] * b[1];
            const double area = std::abs(a[0] * b[1] - a[1] * b[0]);
            const double root = std::sqrt(std::max(sum * sum - 4 * area * area, 0.0));
            const double cosine = std::sqrt((sum - root) / (sum + root));
            return std::acos(std::min(cosine, 1.0)) * 180 / std::numbers::pi;
        }
    }
    return std::nullopt;
}

/// Returns the mean squared second difference of the grey levels. The second difference at a pixel
/// is its grey level minus the mean grey level of two pixels on opposite sides, at a distance of
/// `step_px`. Noise contributes the same amount at any distance, and linear brightness gradients
/// contribute nothing.
double second_difference(ImageView image, int step_px) {
    std::int64_t squares = 0;
    for (int v = step_px; v + step_px < image.height_px; ++v) {
        for (int u = step_px; u + step_px < image.width_px; ++u) {
            const int twice = 2 * image.row(v)[u];
            const int along = image.row(v)[u - step_px] + image.row(v)[u + step_px] - twice;
            const int down = image.row(v - step_px)[u] + image.row(v + step_px)[u] - twice;
            squares += along * along + down * down;
        }
    }
    const double samples = 2.0 * (image.width_px - 2 * step_px) * (image.height_px - 2 * step_px);
    return static_cast<double>(squares) / (4 * samples);
}

/// Returns true if the image contains only coarse details, as in a picture that is out of focus.
/// The measure of fine details is the second difference over 2 px. The measure of coarse details is
/// the larger of the second differences over 8 and 16 px. The second difference over 1 px estimates
/// the noise and is subtracted from both measures. The ratio of fine to coarse details is at least
/// 1/6 in a focused picture, even at a tilt of 70 degrees, and below 1/20 if the dots are too
/// blurred to be read. Returns false if the image is too small for this test.
bool is_out_of_focus(ImageView image) {
    constexpr double kMinDetail = 0.4;
    constexpr double kFocused = 0.06;
    constexpr int kMaxStep_px = 16;
    if (std::min(image.width_px, image.height_px) <= 2 * kMaxStep_px) return false;
    const double noise = second_difference(image, 1);
    const double detail =
        std::max(second_difference(image, 8), second_difference(image, kMaxStep_px)) - noise;
    return detail > kMinDetail && second_difference(image, 2) - noise < kFocused * detail;
}

/// Downscales the image by a factor of `by`. Each pixel of the result is the mean of a block of
/// `by` x `by` pixels.
GreyImage reduced_by(ImageView image, int by) {
    GreyImage small{{}, image.width_px / by, image.height_px / by};
    for (int v = 0; v < small.height_px; ++v) {
        for (int u = 0; u < small.width_px; ++u) {
            int sum = 0;
            for (int k = 0; k < by * by; ++k)
                sum += image.row(v * by + k / by)[u * by + k % by];
            small.pixels.push_back(static_cast<std::uint8_t>(sum / (by * by)));
        }
    }
    return small;
}

/// Downscales the image by increasing factors until it shows a grid of dots whose spacing, in px of
/// the original image, exceeds kMaxSpacing_px. Returns this spacing, or nullopt if no downscaled
/// image shows such a grid.
std::optional<double> too_large_spacing_px(ImageView image, const DeviceOptions& options,
                                           LargeMemory& scratch) {
    constexpr double kMaxSpacing_px = 60;
    // Minimum number of dots in the grid. It is small because a camera that is too close to the
    // paper sees only a few dots.
    constexpr int kMinDots = 16;
    DeviceOptions blobs;
    blobs.code = options.code;
    // The trace contains the grid of blobs only at this effort level.
    blobs.effort = Effort::device;
    blobs.lattice.min_dots = kMinDots;
    for (const int by : {2, 4, 8, 16}) {
        if (std::min(image.width_px, image.height_px) / by < kMinFrameSide_px) break;
        const GreyImage small = reduced_by(image, by);
        Locator locator(scratch, blobs);
        const Fix fix = locator.locate(small.view());
        const bool has_grid = fix.status == Status::ok || fix.status == Status::grid_too_small ||
                              fix.status == Status::not_in_code ||
                              fix.status == Status::ambiguous || fix.status == Status::not_certain;
        if (!has_grid) continue;
        const FixedVec u_q16 = locator.trace().lattice.u_q16;
        const double spacing_px = fix.status == Status::ok
                                      ? by * fix.spacing_px()
                                      : by * std::hypot(u_q16.x, u_q16.y) / 65536.0;
        if (spacing_px > kMaxSpacing_px) return spacing_px;
    }
    return std::nullopt;
}

/// Returns true if the inverted image can be located, which implies that the dots are white on
/// black.
bool is_inverted(ImageView image, const DeviceOptions& options, LargeMemory& scratch) {
    GreyImage inverted = reduced_by(image, 1);
    for (std::uint8_t& grey : inverted.pixels)
        grey = static_cast<std::uint8_t>(255 - grey);
    DeviceOptions once = options;
    once.effort = Effort::once;
    return Locator(scratch, once).locate(inverted.view()).status == Status::ok;
}

/// Returns advice to specify a code, or an empty string. If the code is not given, a position
/// may be uncertain only because positions in other codes are also possible. If the position is
/// certain when only one of the codes is tried, the advice names this code.
std::string advice_on_code(ImageView image, const DeviceOptions& options, LargeMemory& scratch) {
    for (const CodeVariant code :
         {CodeVariant::anoto, CodeVariant::libdots, CodeVariant::microdots}) {
        DeviceOptions given = options;
        given.code = code;
        const Fix fix = Locator(scratch, given).locate(image);
        if (fix.status != Status::ok) continue;
        return fmt::format(
            "the reason is that the code is not known: in code {0} alone, the position is certain "
            "(p_wrong {1}); give --code {0} if this code was printed, or show more of the sheet",
            name(code), p_wrong_text(fix.p_wrong()));
    }
    return {};
}

std::string advice_on_distance(ImageView image, const DeviceOptions& options,
                               LargeMemory& scratch) {
    if (const auto spacing_px = too_small_spacing_px(image, options, scratch)) {
        return fmt::format(
            "the picture is too coarse, its dots are {:.1f} px apart and at least 6 "
            "are needed: come closer, or take more pixels",
            *spacing_px);
    }
    if (const auto spacing_px = too_large_spacing_px(image, options, scratch)) {
        return fmt::format(
            "the camera is too near, its dots are {:.0f} px apart and at most 60 can be read, of "
            "which 8 x 8 must be in view: move it away, or make the picture smaller if it shows "
            "that many",
            *spacing_px);
    }
    return {};
}

/// Returns advice on tilt, compression and focus.
std::string advice_on_quality(ImageView image, const PictureFacts& facts, LargeMemory& scratch) {
    if (const auto tilt_degrees = large_tilt_degrees(image, facts.options, scratch)) {
        return fmt::format(
            "the sheet is tilted too much, by about {:.0f} degrees: look straight down on it",
            *tilt_degrees);
    }
    // Minimum number of bits per pixel of a video, with a margin. If the frames are sharp, H.264
    // and HEVC begin to lose dots at 0.1 bits per pixel (docs/live.md).
    constexpr double kTooFewBits_per_px = 0.15;
    if (facts.bits_per_px > 0 && facts.bits_per_px < kTooFewBits_per_px) {
        return fmt::format(
            "the video is compressed too much, to {:.2g} bits per pixel, which blurs its dots: "
            "record it with a higher quality, in H.264 with a CRF of 28 or less",
            facts.bits_per_px);
    }
    if (is_out_of_focus(image)) {
        return "the picture is out of focus, shaken, or too coarse (a spacing under 6 px, as of a "
               "page on a screen): focus, change the distance, hold still, or enlarge the "
               "page";
    }
    if (facts.status != Status::no_grid) return {};
    return "the sheet may be out of focus, too far away (a spacing under 6 px) or strongly "
           "tilted: focus, come closer, and look straight down";
}

}  // namespace

std::string advice_on(ImageView image, const PictureFacts& facts, LargeMemory& scratch) {
    const Status status = facts.status;
    const DeviceOptions& options = facts.options;
    if (status == Status::ok || status == Status::image_too_small ||
        status == Status::image_too_large || status == Status::ambiguous_code) {
        return {};
    }
    if (status == Status::mirrored) {
        return "the cause is a mirror, a projection from behind or a camera that mirrors: locate "
               "with --flip, or 'flip: true' in the camera file";
    }
    if (is_inverted(image, options, scratch)) {
        return "the dots are white on black: locate with --inverted";
    }
    // Minimum grey level of the paper. The contrast of a dot cannot exceed the grey level of the
    // paper. Blur may reduce the contrast to a quarter of that level, and even the reduced contrast
    // must be at least min_contrast.
    const int darkest_paper = 4 * options.threshold.min_contrast;
    if (const int level = paper_level(image); level < darkest_paper) {
        return fmt::format(
            "the picture is too dark, its paper has grey level {} of 255: use more light or a "
            "longer exposure",
            level);
    }
    if (status == Status::no_contrast) {
        return "the dots may be pale, far out of focus or much too small in the picture: use more "
               "light, focus, or come closer";
    }
    if (std::string advice = advice_on_distance(image, options, scratch); !advice.empty())
        return advice;
    if (status == Status::not_certain && !facts.code_is_given) {
        if (std::string advice = advice_on_code(image, options, scratch); !advice.empty())
            return advice;
    }
    return advice_on_quality(image, facts, scratch);
}

}  // namespace dotpose::cli
