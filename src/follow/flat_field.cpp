#include "dotpose/tools/flat_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dotpose {
namespace {

/// Position of a pixel between the two nearest of `count` equidistant points along an axis.
struct Between {
    std::size_t first;  ///< index of the point at or before the pixel, from 0 to `count` - 2
    double part;        ///< fraction of the way from this point to the next
};

Between between(int px, int side_px, std::size_t count) {
    const double at = side_px > 1 ? static_cast<double>(px) * static_cast<double>(count - 1) /
                                        static_cast<double>(side_px - 1)
                                  : 0;
    const std::size_t first = std::min(static_cast<std::size_t>(at), count - 2);
    return {first, at - static_cast<double>(first)};
}

}  // namespace

FlatFieldCorrection::FlatFieldCorrection(const Camera& camera)
    : width_px_(camera.width_px), height_px_(camera.height_px) {
    const auto& field = camera.flat_field;
    const auto at = [](const std::vector<double>& row, const Between& u) {
        return std::lerp(row[u.first], row[u.first + 1], u.part);
    };
    gains_q8_.reserve(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_));
    for (int row = 0; row < height_px_; ++row) {
        const Between v = between(row, height_px_, field.size());
        for (int column = 0; column < width_px_; ++column) {
            const Between u = between(column, width_px_, field.front().size());
            const double brightness =
                std::lerp(at(field[v.first], u), at(field[v.first + 1], u), v.part);
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
