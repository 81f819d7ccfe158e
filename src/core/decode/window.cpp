#include "core/decode/window.hpp"

#include <array>

#include "core/decode/likelihood.hpp"

namespace dotpose::core {

GridRegion choose_window(const Grid& grid, int side) {
    const int columns = std::min(side, grid.columns);
    const int rows = std::min(side, grid.rows);
    GridRegion window{grid.i0, grid.j0, columns, rows};
    if (columns == grid.columns && rows == grid.rows) return window;
    // Total quality of each column within the rows of the window, updated as the window moves down.
    std::array<std::int32_t, kMaxGridSide> column_sums{};
    std::int32_t best = -1;
    const GridCell* cell = grid.storage.data();
    for (int j = 0; j < grid.rows; ++j) {
        std::int32_t sum = 0;
        for (int i = 0; i < grid.columns; ++i, ++cell) {
            std::int32_t& column = column_sums[static_cast<std::size_t>(i)];
            column += quality(*cell);
            if (j >= rows) column -= quality(cell[-rows * grid.columns]);
            sum += column;
            if (i >= columns) sum -= column_sums[static_cast<std::size_t>(i - columns)];
            if (sum <= best || i < columns - 1 || j < rows - 1) continue;
            best = sum;
            window.i0 = grid.i0 + i - columns + 1;
            window.j0 = grid.j0 + j - rows + 1;
        }
    }
    return window;
}

int mean_quality_q8(const Grid& grid, const GridRegion& region) {
    constexpr int kPerfect = 127 * 127;
    std::int64_t sum = 0;
    for (int j = region.j0; j < region.j0 + region.rows; ++j) {
        for (int i = region.i0; i < region.i0 + region.columns; ++i)
            sum += quality(grid.at(i, j));
    }
    return static_cast<int>(sum * 256 / (std::int64_t{region.columns} * region.rows * kPerfect));
}

}  // namespace dotpose::core
