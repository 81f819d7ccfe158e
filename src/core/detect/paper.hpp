// Paper: the grey level of the paper all over the image, also under dots and graphics.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/stages.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Measures the paper in blocks of a tenth of the shorter side, as the level that a third of their
/// pixels exceed.
void measure_paper(const ImageView& image, PaperMap& map);

/// Returns the block of a pixel; outside the image, the nearest block.
inline std::size_t block_at(const PaperMap& map, int u, int v) {
    const int column = std::clamp(u / map.block_px, 0, map.columns - 1);
    const int row = std::clamp(v / map.block_px, 0, map.rows - 1);
    return static_cast<std::size_t>(row * map.columns + column);
}

/// Returns the brightest paper among a pixel's block and the eight around it.
inline int brightest_paper_near(const PaperMap& map, int u, int v) {
    return map.brightest[block_at(map, u, v)];
}

/// Returns the paper at a pixel: that of its block, or if graphics cover most of that, the
/// brightest around it.
inline int paper_at(const PaperMap& map, int u, int v) {
    return map.levels[block_at(map, u, v)];
}

}  // namespace dotpose::core
