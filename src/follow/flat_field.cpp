#include "dotpose/tools/flat_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dotpose {
FlatFieldCorrection::FlatFieldCorrection(const Camera& camera)
    : width_px_(camera.width_px), height_px_(camera.height_px) {
    gains_q8_.reserve(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_));
    for (int v = 0; v < height_px_; ++v) {
        for (int u = 0; u < width_px_; ++u) {
            const double brightness = brightness_at(camera, {double(u), double(v)});
            gains_q8_.push_back(static_cast<std::uint16_t>(std::lround(256 / brightness)));
        }
    }
}

GreyImage FlatFieldCorrection::corrected(ImageView image) const {
    if (image.width_px != width_px_ || image.height_px != height_px_)
        throw BadArgument("the flat field belongs to images of another size");
    GreyImage result{std::vector<std::uint8_t>(gains_q8_.size()), width_px_, height_px_};
    const auto evenly_lit = [](unsigned level, unsigned gain_q8) {
        return static_cast<std::uint8_t>(std::min((level * gain_q8 + 128) >> 8, 255U));
    };
    auto gains_q8 = gains_q8_.begin();
    auto to = result.pixels.begin();
    for (int v = 0; v < height_px_; ++v, gains_q8 += width_px_)
        to = std::transform(image.row(v), image.row(v) + width_px_, gains_q8, to, evenly_lit);
    return result;
}

}  // namespace dotpose
