#include "simulate/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dotpose::simulate {
namespace {

// Returns the integral of the cumulative normal distribution with standard deviation `sigma`, from
// minus infinity to x. For sigma = 0, the distribution is a step.
double integral_of_edge(double x, double sigma) {
    if (sigma < 1e-6) return std::max(x, 0.0);
    const double z = x / sigma;
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
    return sigma * (z * 0.5 * std::erfc(-z / std::numbers::sqrt2) + density);
}

// Returns the weights for a scene that is shifted by `shift_px`. The response of a pixel is a box 1
// px wide, convolved with the Gaussian blur of the lens. The weight of a sub-pixel is the integral
// of this response over the sub-pixel. The weights are scaled to sum to `fraction`.
Kernel::Weights weights(const Kernel& kernel, double sigma_px, double shift_px, double fraction) {
    const auto pixels = static_cast<std::size_t>(2 * kernel.border_px + 1);
    const auto per_pixel = static_cast<std::size_t>(kernel.per_pixel);
    // edges[i] is `integral_of_edge` at the point half a pixel to the left of sub-pixel i's left
    // edge.
    std::vector<double> edges;
    for (std::size_t i = 0; i <= (pixels + 1) * per_pixel; ++i) {
        edges.push_back(integral_of_edge(
            static_cast<double>(i) / kernel.per_pixel - kernel.border_px - 1 + shift_px, sigma_px));
    }
    // Returns the integral of the response from minus infinity to a border between sub-pixels.
    const auto collected = [&](std::size_t border) {
        return edges[border + per_pixel] - edges[border];
    };
    std::vector<double> exact;
    double sum = 0;
    for (std::size_t i = 0; i < pixels * per_pixel; ++i) {
        exact.push_back(collected(i + 1) - collected(i));
        sum += exact.back();
    }
    Kernel::Weights result(per_pixel, std::vector<float>(kernel.taps));
    for (std::size_t i = 0; i < exact.size(); ++i) {
        // The weights are indexed by the offset from the sub-pixel to the pixel, which is the
        // negative of the offset from the pixel to the sub-pixel. The order is therefore reversed.
        result[i % per_pixel][pixels - 1 - i / per_pixel] =
            static_cast<float>(exact[i] * fraction / sum);
    }
    return result;
}

// Returns the number of sub-pixels per pixel along each axis. With about 6 or more sub-pixels
// across a dot, sampling moves its centroid by less than 0.003 px.
int sub_pixels_for(double dot_px) {
    if (dot_px < 1.5) return 8;
    return dot_px < 6 ? 4 : 2;
}

}  // namespace

Kernel make_kernel(const Imperfections& imperfections, double dot_px) {
    const Vec2 motion_px = imperfections.motion_px;
    const double length_px = std::hypot(motion_px.x, motion_px.y);

    Kernel kernel;
    kernel.per_pixel =
        imperfections.sub_pixels > 0 ? imperfections.sub_pixels : sub_pixels_for(dot_px);
    // Ink is drawn as the covered fraction of each sub-pixel. This blurs the ink like a triangle
    // filter that is two sub-pixels wide and has a variance of 1/6 sub-pixel^2. The Gaussian
    // provides the remaining blur.
    const double raster_variance = 1.0 / (6.0 * kernel.per_pixel * kernel.per_pixel);
    const double sigma_px = std::sqrt(
        std::max(0.0, imperfections.blur_sigma_px * imperfections.blur_sigma_px - raster_variance));
    kernel.border_px = static_cast<int>(
        std::ceil(4 * sigma_px + std::max(std::abs(motion_px.x), std::abs(motion_px.y)) / 2));
    kernel.taps = (static_cast<std::size_t>(2 * kernel.border_px + 1) + 3) / 4 * 4;
    // Motion blur is approximated by the sum of the images at several moments, at which the scene
    // is at rest. From one moment to the next, the scene moves by at most one sub-pixel.
    const int moments = std::max(1, static_cast<int>(std::ceil(length_px * kernel.per_pixel)));
    for (int moment = 0; moment < moments; ++moment) {
        const double time = (moment + 0.5) / moments - 0.5;
        kernel.moments.push_back({weights(kernel, sigma_px, time * motion_px.x, 1),
                                  weights(kernel, sigma_px, time * motion_px.y, 1.0 / moments)});
    }
    return kernel;
}

}  // namespace dotpose::simulate
