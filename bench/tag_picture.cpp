#include "tag_picture.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace dotpose::bench {

GreyImage draw_tag(const apriltag_family_t& family, int id, int px_per_square) {
    const int squares = family.total_width;
    const int side_px = squares * px_per_square;
    GreyImage image{{}, side_px, side_px};
    image.pixels.assign(static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px), 255);
    const auto fill = [&](int x, int y, int side, std::uint8_t level) {
        for (int v = y * px_per_square; v < (y + side) * px_per_square; ++v) {
            const auto row = image.pixels.begin() + v * side_px;
            std::fill_n(row + x * px_per_square, side * px_per_square, level);
        }
    };
    const int border = (squares - family.width_at_border) / 2;
    fill(border, border, family.width_at_border, 0);
    for (std::uint32_t i = 0; i < family.nbits; ++i) {
        const bool is_white = (family.codes[id] >> (family.nbits - 1 - i) & 1) == 1;
        const auto x = static_cast<int>(family.bit_x[i]);
        const auto y = static_cast<int>(family.bit_y[i]);
        if (is_white) fill(border + x, border + y, 1, 255);
    }
    return image;
}

}  // namespace dotpose::bench
