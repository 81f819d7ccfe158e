#include "core/detect/paper.hpp"

#include <algorithm>
#include <array>

#include "core/detect/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::paper;

constexpr int kSamplesPerSide = tuned::kSamplesPerSide;

int blocks_along(int length_px, int side) {
    return (length_px - 1) / side + 1;
}

/// Returns the paper level of a block: the highest grey level that at least a third of the evenly
/// spaced samples reach or exceed.
std::uint8_t paper_of_block(const ImageView& image, int u0, int v0, int side) {
    static_assert(kSamplesPerSide * kSamplesPerSide <= UINT8_MAX);
    std::array<std::uint8_t, 256> pixels_of_level{};
    int count = 0;
    const int step = std::max(side / kSamplesPerSide, 1);
    for (int v = v0; v < std::min(v0 + kSamplesPerSide * step, image.height_px); v += step) {
        for (int u = u0; u < std::min(u0 + kSamplesPerSide * step, image.width_px); u += step) {
            ++pixels_of_level[image.row(v)[u]];
            ++count;
        }
    }
    std::size_t level = pixels_of_level.size() - 1;
    for (int above = pixels_of_level[level]; above < count - tuned::kDarker_3rds * count / 3;)
        above += pixels_of_level[--level];
    return static_cast<std::uint8_t>(level);
}

/// Calls `use(level)` for each block in the 3 x 3 neighbourhood of the given block, including the
/// block itself. Skips blocks outside the image.
template <typename Use>
void visit_around(const PaperMap& map, int column, int row, Use use) {
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, map.rows - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, map.columns - 1); ++c)
            use(map.levels[static_cast<std::size_t>(r * map.columns + c)]);
    }
}

}  // namespace

void measure_paper(const ImageView& image, PaperMap& map) {
    map.block_px = std::min(image.width_px, image.height_px) / tuned::kBlockPart;
    map.columns = blocks_along(image.width_px, map.block_px);
    map.rows = blocks_along(image.height_px, map.block_px);
    std::size_t blocks = 0;
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            map.levels[blocks++] =
                paper_of_block(image, column * map.block_px, row * map.block_px, map.block_px);
        }
    }
    std::size_t block = 0;
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            std::uint8_t brightest = 1;
            visit_around(map, column, row,
                         [&](std::uint8_t level) { brightest = std::max(brightest, level); });
            map.brightest[block++] = brightest;
        }
    }
    for (block = 0; block < blocks; ++block) {
        std::uint8_t& level = map.levels[block];
        const std::uint8_t brightest = map.brightest[block];
        level = 4 * level >= tuned::kCovered_4ths * brightest ? std::max<std::uint8_t>(level, 1)
                                                              : brightest;
    }
}

}  // namespace dotpose::core
