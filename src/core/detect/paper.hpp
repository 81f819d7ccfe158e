// Paper: estimates the grey level of the paper in each part of the image, even under dots and
// graphics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/image.hpp"

namespace dotpose::core {

/// Paper levels of square image blocks.
struct PaperMap {
    int block_px = 0;
    int columns = 0;
    int rows = 0;
    std::span<std::uint8_t> levels;  ///< paper levels of the blocks, row by row
    /// For each block, the maximum paper level over this block and the adjacent blocks.
    std::span<std::uint8_t> brightest;
};

/// Measures the paper level of each block: the highest grey level that at least a third of the
/// sampled pixels reach or exceed. If a block is much darker than an adjacent block, it is assumed
/// to be under graphics, and its level is replaced with that of its brightest neighbour. The block
/// side is a tenth of the shorter image side.
void measure_paper(const ImageView& image, PaperMap& map);

/// Returns the index of the block at a pixel. Pixels outside the image belong to the nearest block.
inline std::size_t block_at(const PaperMap& map, int u, int v) {
    const int column = std::clamp(u / map.block_px, 0, map.columns - 1);
    const int row = std::clamp(v / map.block_px, 0, map.rows - 1);
    return static_cast<std::size_t>(row * map.columns + column);
}

/// Returns the highest paper level among the block at a pixel and the blocks adjacent to it.
inline int brightest_paper_near(const PaperMap& map, int u, int v) {
    return map.brightest[block_at(map, u, v)];
}

/// Returns the paper level at a pixel. The level is at least 1.
inline int paper_at(const PaperMap& map, int u, int v) {
    return map.levels[block_at(map, u, v)];
}

}  // namespace dotpose::core
