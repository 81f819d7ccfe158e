#include "core/pixels/paper.hpp"

#include <algorithm>
#include <array>

namespace dotpose::core {
namespace {

constexpr int kSamplesPerSide = 12;

int blocks_along(int length_px, int side) {
    return (length_px - 1) / side + 1;
}

std::uint8_t paper_of_block(const ImageView& image, int u0, int v0, int side) {
    std::array<std::uint8_t, kSamplesPerSide * kSamplesPerSide> levels{};
    std::size_t count = 0;
    const int step = std::max(side / kSamplesPerSide, 1);
    for (int v = v0; v < std::min(v0 + kSamplesPerSide * step, image.height_px); v += step) {
        for (int u = u0; u < std::min(u0 + kSamplesPerSide * step, image.width_px); u += step) {
            levels[count++] = image.row(v)[u];
        }
    }
    const auto third = levels.begin() + static_cast<std::ptrdiff_t>(2 * count / 3);
    std::nth_element(levels.begin(), third, levels.begin() + static_cast<std::ptrdiff_t>(count));
    return *third;
}

int level(const PaperMap& map, int column, int row) {
    return map.levels[static_cast<std::size_t>(row * map.columns + column)];
}

/// The nearest to a pixel, which may lie outside the image.
Vec block_at(const PaperMap& map, int u, int v) {
    return {std::clamp(u / map.block_px, 0, map.columns - 1),
            std::clamp(v / map.block_px, 0, map.rows - 1)};
}

}  // namespace

void measure_paper(const ImageView& image, PaperMap& map) {
    map.block_px = std::min(image.width_px, image.height_px) / 10;
    map.columns = blocks_along(image.width_px, map.block_px);
    map.rows = blocks_along(image.height_px, map.block_px);
    std::size_t block = 0;
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            map.levels[block++] =
                paper_of_block(image, column * map.block_px, row * map.block_px, map.block_px);
        }
    }
}

int brightest_paper_near(const PaperMap& map, int u, int v) {
    const Vec block = block_at(map, u, v);
    int brightest = 1;
    for (int r = std::max(block.y - 1, 0); r <= std::min(block.y + 1, map.rows - 1); ++r) {
        for (int c = std::max(block.x - 1, 0); c <= std::min(block.x + 1, map.columns - 1); ++c) {
            brightest = std::max(brightest, level(map, c, r));
        }
    }
    return brightest;
}

int paper_at(const PaperMap& map, int u, int v) {
    const Vec block = block_at(map, u, v);
    const int own = level(map, block.x, block.y);
    const int brightest = brightest_paper_near(map, u, v);
    return 4 * own >= 3 * brightest ? std::max(own, 1) : brightest;
}

}  // namespace dotpose::core
