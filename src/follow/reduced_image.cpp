#include "follow/reduced_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "dotpose/locate.hpp"

namespace dotpose::follow_detail {

int reduction_of(int width_px, int height_px) {
    const int by = (std::max(width_px, height_px) + kMaxFrameSide_px - 1) / kMaxFrameSide_px;
    return by > 1 && std::min(width_px, height_px) / by >= kMinFrameSide_px ? by : 1;
}

GreyImage reduced(ImageView image, int by) {
    GreyImage result{{}, image.width_px / by, image.height_px / by};
    result.pixels.reserve(static_cast<std::size_t>(result.width_px) *
                          static_cast<std::size_t>(result.height_px));
    const int area = by * by;
    for (int v = 0; v < result.height_px; ++v) {
        for (int u = 0; u < result.width_px; ++u) {
            std::int64_t sum = area / 2;
            for (int row = v * by; row < (v + 1) * by; ++row) {
                for (int column = u * by; column < (u + 1) * by; ++column)
                    sum += image.row(row)[column];
            }
            result.pixels.push_back(static_cast<std::uint8_t>(sum / area));
        }
    }
    return result;
}

DeviceOptions reduced(const DeviceOptions& options, ImageView image, int by) {
    // Converts an offset from the image centre to the reduced image. The reduction divides
    // distances from the top left corner by `by`. Offsets from the centre do not scale exactly,
    // because dropping pixels at the right or bottom edge moves the centre.
    const auto offset_q8 = [by](std::int32_t whole_q8, int side_px) {
        const double from_corner_px = side_px / 2.0 + whole_q8 / 256.0;
        return static_cast<std::int32_t>(
            std::lround((from_corner_px / by - (side_px / by) / 2.0) * 256));
    };
    DeviceOptions result = options;
    result.reference_dx_q8 = offset_q8(options.reference_dx_q8, image.width_px);
    result.reference_dy_q8 = offset_q8(options.reference_dy_q8, image.height_px);
    result.lens.centre_dx_q8 = offset_q8(options.lens.centre_dx_q8, image.width_px);
    result.lens.centre_dy_q8 = offset_q8(options.lens.centre_dy_q8, image.height_px);
    using Limits = std::numeric_limits<std::int32_t>;
    result.lens.k_q40 = static_cast<std::int32_t>(std::clamp<std::int64_t>(
        std::int64_t{options.lens.k_q40} * by * by, Limits::min(), Limits::max()));
    return result;
}

Fix in_whole_pixels(const Fix& fix, int by) {
    Fix result = fix;
    result.spacing_px_q16 *= by;
    result.residual_px *= static_cast<float>(by);
    return result;
}

}  // namespace dotpose::follow_detail
