// Functions that draw small test images, and run the pixel stages on them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/blobs.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "geometry.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test {

inline GreyImage blank(int width_px, int height_px, int level = 200) {
    GreyImage image{{}, width_px, height_px};
    image.pixels.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                        static_cast<std::uint8_t>(level));
    return image;
}

inline std::uint8_t& pixel(GreyImage& image, int u, int v) {
    return image.pixels[static_cast<std::size_t>(v * image.width_px + u)];
}

inline void fill(GreyImage& image, int u0, int v0, int u1, int v1, int level) {
    for (int v = v0; v < v1; ++v) {
        for (int u = u0; u < u1; ++u)
            pixel(image, u, v) = static_cast<std::uint8_t>(level);
    }
}

/// Returns the integral over the pixel at `u` of a Gaussian with mean `centre`, standard deviation
/// `sigma` and total integral 1.
inline double gaussian_fraction(int u, double centre, double sigma) {
    const double scale = sigma * std::numbers::sqrt2;
    return 0.5 * (std::erf((u + 0.5 - centre) / scale) - std::erf((u - 0.5 - centre) / scale));
}

/// Darkens the image by a Gaussian spot that removes the fraction `depth` of the light at its
/// centre. The spot is integrated over each pixel, so its centroid is exact up to the rounding of
/// the levels.
inline void darken(GreyImage& image, Vec2 centre, double sigma, double depth) {
    const double peak = depth * 2 * std::numbers::pi * sigma * sigma;
    const int reach = static_cast<int>(6 * sigma) + 2;
    for (int v = static_cast<int>(centre.y) - reach; v <= static_cast<int>(centre.y) + reach; ++v) {
        for (int u = static_cast<int>(centre.x) - reach; u <= static_cast<int>(centre.x) + reach;
             ++u) {
            if (u < 0 || v < 0 || u >= image.width_px || v >= image.height_px) continue;
            const double fraction =
                gaussian_fraction(u, centre.x, sigma) * gaussian_fraction(v, centre.y, sigma);
            std::uint8_t& level = pixel(image, u, v);
            level = static_cast<std::uint8_t>(
                std::lround(level * (1 - std::min(peak * fraction, 1.0))));
        }
    }
}

/// The two thresholds at one column of the most recently measured band.
struct Levels {
    int low = 0;
    int high = 0;
};
inline Levels levels_at(const AdaptiveThreshold& threshold, int u) {
    const auto column = static_cast<std::size_t>(u);
    return {2 * threshold.half_low_levels[column], threshold.high_levels[column]};
}
inline Levels levels_of_tile(const AdaptiveThreshold& threshold, int tile) {
    return levels_at(threshold, tile * kTileWidth_px);
}

/// Returns the blobs of an image that are candidates for dots, before the size filter.
inline std::vector<DetectedDot> blobs_of(const GreyImage& image, Workspace& w,
                                         const ThresholdOptions& options = {}) {
    const core::DotList list{w.dots, w.dot_count, w.dots_kept_within_px};
    core::begin_threshold(image.width_px, image.height_px, w.threshold);
    core::begin_blobs(w.threshold, w.open, list);
    int band = 0;
    for (int row = 0; row < image.height_px; ++row) {
        for (int ready = core::take_row(image.view().row(row), w.threshold); ready > 0;
             --ready, ++band) {
            core::measure_levels(band, options, w.threshold);
            for (int v = core::band_begin(w.threshold, band); v < core::band_end(w.threshold, band);
                 ++v) {
                core::grow_blobs(v, w.threshold, w.open, list);
            }
        }
    }
    const auto found = w.found_dots();
    return {found.begin(), found.end()};
}

inline std::vector<DetectedDot> blobs_of(const GreyImage& image) {
    static LargeWorkspace workspace;
    return blobs_of(image, workspace);
}

/// Returns the distance, in px, from `place` to the centroid of the nearest dot.
inline double nearest_px(const std::vector<DetectedDot>& dots, Vec2 place) {
    double nearest = 1e9;
    for (const DetectedDot& dot : dots)
        nearest = std::min(nearest, length(real(dot.centre_q8, 8) - place));
    return nearest;
}

}  // namespace dotpose::core_test
