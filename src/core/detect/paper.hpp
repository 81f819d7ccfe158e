// Paper: measures the grey level of the paper everywhere in the image, including under dots and
// graphics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/image.hpp"

namespace dotpose::core {

/// The paper levels of an image, which is divided into square blocks.
struct PaperMap {
    int block_px = 0;
    int columns = 0;
    int rows = 0;
    std::span<std::uint8_t> levels;  ///< paper levels of the blocks, row by row
    /// For each block, the brightest level among the block and the eight blocks around it.
    std::span<std::uint8_t> brightest;
};

/// Measures the paper level of each block. The paper level is the highest grey level that at least
/// a third of the sampled pixels of the block reach. A block that is much darker than the brightest
/// of its eight neighbours is assumed to be covered by graphics. The level of this neighbour
/// replaces its level. The side of a block is a tenth of the shorter side of the image.
void measure_paper(const ImageView& image, PaperMap& map);

/// Returns the index of the block that contains a pixel. Pixels outside the image belong to the
/// nearest block.
inline std::size_t block_at(const PaperMap& map, int u, int v) {
    const int column = std::clamp(u / map.block_px, 0, map.columns - 1);
    const int row = std::clamp(v / map.block_px, 0, map.rows - 1);
    return static_cast<std::size_t>(row * map.columns + column);
}

/// Returns the brightest paper level among the block that contains a pixel and the eight blocks
/// around it.
inline int brightest_paper_near(const PaperMap& map, int u, int v) {
    return map.brightest[block_at(map, u, v)];
}

/// Returns the paper level of the block that contains a pixel. The level is at least 1.
inline int paper_at(const PaperMap& map, int u, int v) {
    return map.levels[block_at(map, u, v)];
}

}  // namespace dotpose::core
