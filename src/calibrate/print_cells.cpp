#include "calibrate/print_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// Minimum fraction of correct dots among the measured cells in an outer line of a field.
constexpr double kMinLineShare = 0.5;
/// Minimum number of correct dots in an outer column or row, as a fraction of the maximum number in
/// any column or row.
constexpr double kMinLength = 0.15;

/// Minimum fraction of correct dots among the dots in an outer line. If the line is outside the
/// field, a quarter of its dots are correct by chance. Half of its dots are correct if the line is
/// in a different region of the code, and the columns of this region happen to match the columns of
/// the field.
constexpr double kMinRightShare = 0.7;

/// Returns the located tiles whose maps are used to predict the cells of a tile. If the tile has a
/// fix, the result is the tile itself. Otherwise, the result contains the located tiles next to it.
/// A tile has no fix, for example, if it shows only the edge of a field.
std::vector<const LocatedTile*> views_of(int tile, const Tiling& tiling, const Field& field) {
    if (const auto& own = field.tiles[static_cast<std::size_t>(tile)]) return {&*own};
    std::vector<const LocatedTile*> views;
    const int column = tile % tiling.columns;
    const int row = tile / tiling.columns;
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, tiling.rows - 1); ++j) {
        for (int i = std::max(column - 1, 0); i <= std::min(column + 1, tiling.columns - 1); ++i) {
            const auto& beside = field.tiles[static_cast<std::size_t>(j * tiling.columns + i)];
            if (beside) views.push_back(&*beside);
        }
    }
    return views;
}

/// Returns true if no other view is nearer to the cell than `view`.
bool is_nearest(const LocatedTile& view, const SeenCell& cell,
                const std::vector<const LocatedTile*>& views) {
    const Vector2d pixel = view.map.pixel(Vector2d(cell.x, cell.y));
    const double distance_px2 = (view.map.centre_px - pixel).squaredNorm();
    return std::ranges::none_of(views, [&](const LocatedTile* other) {
        return (other->map.centre_px - pixel).squaredNorm() < distance_px2;
    });
}

/// Returns a grid without measurements. It covers all cells that the maps of the field's tiles
/// predict in these tiles, plus a margin of two cells.
CellGrid empty_grid(const Tiling& tiling, const Field& field) {
    Vector2d low = Vector2d::Constant(1e18);
    Vector2d high = -low;
    for (int t = 0; t < tiling.count(); ++t) {
        const PixelRect rect = tiling.rect(t);
        for (const LocatedTile* view : views_of(t, tiling, field)) {
            for (const int u : {rect.u_begin, rect.u_end}) {
                for (const int v : {rect.v_begin, rect.v_end}) {
                    const Vector2d cell = view->map.cell(Vector2d(u, v));
                    low = low.cwiseMin(cell - Vector2d::Constant(2));
                    high = high.cwiseMax(cell + Vector2d::Constant(2));
                }
            }
        }
    }
    low = low.cwiseMax(Vector2d::Zero());
    high = high.cwiseMin(Vector2d::Constant(kPositionsPerAxis - 1));
    CellGrid grid;
    grid.origin = {static_cast<std::uint32_t>(low.x()), static_cast<std::uint32_t>(low.y())};
    grid.columns = static_cast<int>(high.x() - grid.origin.x) + 1;
    grid.rows = static_cast<int>(high.y() - grid.origin.y) + 1;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            SeenCell& cell = grid.cells.emplace_back();
            cell.x = grid.origin.x + static_cast<std::uint32_t>(i);
            cell.y = grid.origin.y + static_cast<std::uint32_t>(j);
            cell.nominal = field.code.symbol(cell.x, cell.y);
        }
    }
    return grid;
}

/// Counts for one column or row: measured cells, cells with a dot, and correct dots.
struct Coverage {
    int seen = 0;
    int dots = 0;
    int right = 0;
};

/// Removes outer columns and rows from a grid until all four outer lines belong to the field.
class Trimmer {
  public:
    Trimmer(const CellGrid& grid, const std::vector<bool>& seen) : grid_(grid), seen_(seen) {
        i_end_ = grid.columns;
        j_end_ = grid.rows;
        for (int i = 0; i < grid.columns; ++i)
            longest_column_ = std::max(longest_column_, column(i).right);
        for (int j = 0; j < grid.rows; ++j)
            longest_row_ = std::max(longest_row_, row(j).right);
    }

    CellGrid trimmed() {
        while (i_begin_ < i_end_ && j_begin_ < j_end_ && remove_worst_line()) {
        }
        CellGrid result;
        result.origin = {grid_.origin.x + static_cast<std::uint32_t>(i_begin_),
                         grid_.origin.y + static_cast<std::uint32_t>(j_begin_)};
        result.columns = std::max(i_end_ - i_begin_, 0);
        result.rows = result.columns > 0 ? std::max(j_end_ - j_begin_, 0) : 0;
        for (int j = j_begin_; j < j_begin_ + result.rows; ++j) {
            for (int i = i_begin_; i < i_end_; ++i)
                result.cells.push_back(grid_.at(i, j));
        }
        return result;
    }

  private:
    /// Removes the worst outer line that does not belong to the field. Returns false if all four
    /// outer lines belong to the field. Removes only one line at a time, because rows beside the
    /// field contribute wrong dots to its columns.
    bool remove_worst_line() {
        struct Outer {
            Coverage line;
            int longest;
            int* end;
            int step;
        };
        const std::array outer = {Outer{column(i_begin_), longest_column_, &i_begin_, 1},
                                  Outer{column(i_end_ - 1), longest_column_, &i_end_, -1},
                                  Outer{row(j_begin_), longest_row_, &j_begin_, 1},
                                  Outer{row(j_end_ - 1), longest_row_, &j_end_, -1}};
        const Outer* worst = nullptr;
        double worst_fraction = 1;
        for (const Outer& one : outer) {
            if (is_enough(one.line, one.longest)) continue;
            // Lines with too few correct dots are removed first. Their fraction of correct dots is
            // treated as 0, because it is not significant.
            const double fraction =
                is_long(one.line, one.longest) ? double(one.line.right) / one.line.seen : 0;
            if (worst != nullptr && fraction >= worst_fraction) continue;
            worst = &one;
            worst_fraction = fraction;
        }
        if (worst == nullptr) return false;
        *worst->end += worst->step;
        return true;
    }

    void count(int i, int j, Coverage& coverage) const {
        const auto index = static_cast<std::size_t>(j) * static_cast<std::size_t>(grid_.columns) +
                           static_cast<std::size_t>(i);
        coverage.seen += seen_[index] ? 1 : 0;
        coverage.dots += grid_.cells[index].has_dot ? 1 : 0;
        coverage.right += grid_.cells[index].is_right() ? 1 : 0;
    }
    Coverage column(int i) const {
        Coverage coverage;
        for (int j = j_begin_; j < j_end_; ++j)
            count(i, j, coverage);
        return coverage;
    }
    Coverage row(int j) const {
        Coverage coverage;
        for (int i = i_begin_; i < i_end_; ++i)
            count(i, j, coverage);
        return coverage;
    }

    static bool is_long(const Coverage& line, int longest) {
        return line.right > kMinLength * longest;
    }
    /// Returns true if a line belongs to the field. A line with only a few correct dots is
    /// rejected, because it may be cropped or contain other print.
    static bool is_enough(const Coverage& line, int longest) {
        return line.right >= kMinLineShare * line.seen &&
               line.right >= kMinRightShare * line.dots && is_long(line, longest);
    }

    const CellGrid& grid_;
    const std::vector<bool>& seen_;
    int longest_column_ = 0;
    int longest_row_ = 0;
    int i_begin_ = 0;
    int i_end_ = 0;
    int j_begin_ = 0;
    int j_end_ = 0;
};

}  // namespace

CellGrid collect_cells(const ImageView& scan, const Tiling& tiling, const Field& field) {
    CellGrid grid = empty_grid(tiling, field);
    std::vector<bool> seen(grid.cells.size());
    for (int t = 0; t < tiling.count(); ++t) {
        const auto views = views_of(t, tiling, field);
        for (const LocatedTile* view : views) {
            for (const SeenCell& cell :
                 measure_cells(scan, tiling.rect(t), view->map, view->levels, field.code)) {
                if (!is_nearest(*view, cell, views)) continue;
                const std::int64_t i = std::int64_t{cell.x} - grid.origin.x;
                const std::int64_t j = std::int64_t{cell.y} - grid.origin.y;
                if (i < 0 || j < 0 || i >= grid.columns || j >= grid.rows) continue;
                const auto index = static_cast<std::size_t>(j * grid.columns + i);
                // Cells along the border between two tiles are measured in both tiles. A correct
                // measurement takes precedence.
                if (!grid.cells[index].is_right()) grid.cells[index] = cell;
                seen[index] = true;
            }
        }
    }
    return Trimmer(grid, seen).trimmed();
}

}  // namespace dotpose::calibrate
