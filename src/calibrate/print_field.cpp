#include "calibrate/print_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// Anchors continue each other if their cells agree to so many cells, and to this share of the
/// distance between them: paper creeps, cameras see in perspective.
constexpr double kAgree_cells = 1.5;
constexpr double kAgreeShare = 0.05;
/// A tile belongs to a field if so many of its dots read right, and this share of all. A quarter do
/// by chance; half of them in another region if its columns happen to agree with the field's.
constexpr int kLeastRight = 12;
constexpr double kLeastRightShare = 0.7;
/// Outer lines of cells belong to a field if this share of the cells, and the share above of the
/// dots, read right.
constexpr double kLeastLineShare = 0.5;
/// And if they have this share of the dots of the longest line.
constexpr double kLeastLength = 0.15;

/// The map of the tile in `field` that is nearest to a point, if any.
const LocalMap* nearest_map(const Field& field, const Vector2d& pixel) {
    const LocalMap* nearest = nullptr;
    for (const auto& map : field.maps) {
        if (!map) continue;
        if (nearest == nullptr || (map->centre_px - pixel).squaredNorm() <
                                      (nearest->centre_px - pixel).squaredNorm()) {
            nearest = &*map;
        }
    }
    return nearest;
}

bool continues(const Field& field, const Anchor& anchor) {
    if (!(field.code.section.u == anchor.section.u && field.code.section.v == anchor.section.v)) {
        return false;
    }
    const LocalMap* map = nearest_map(field, anchor.map.centre_px);
    if (map == nullptr) return false;
    const Vector2d expected = map->cell(anchor.map.centre_px);
    const double distance = (expected - map->centre_cell).norm();
    return (expected - anchor.map.centre_cell).norm() <= kAgree_cells + kAgreeShare * distance;
}

bool belongs(const SeenTile& tile) {
    return tile.right >= kLeastRight && tile.right >= kLeastRightShare * tile.dots;
}

double median_of(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// The part of a tile that a map of a tile beside it can be trusted in.
PixelRect part_near(const PixelRect& rect, const Tiling& tiling, const LocalMap& map) {
    const auto low = [&](double centre) {
        return static_cast<int>(std::floor(centre)) - tiling.side_px;
    };
    const auto high = [&](double centre) {
        return static_cast<int>(std::ceil(centre)) + tiling.side_px;
    };
    return {std::max(rect.u_begin, low(map.centre_px.x())),
            std::max(rect.v_begin, low(map.centre_px.y())),
            std::min(rect.u_end, high(map.centre_px.x())),
            std::min(rect.v_end, high(map.centre_px.y()))};
}

std::vector<int> neighbours_of(int tile, const Tiling& tiling) {
    std::vector<int> neighbours;
    const int column = tile % tiling.columns;
    const int row = tile / tiling.columns;
    if (column > 0) neighbours.push_back(tile - 1);
    if (column + 1 < tiling.columns) neighbours.push_back(tile + 1);
    if (row > 0) neighbours.push_back(tile - tiling.columns);
    if (row + 1 < tiling.rows) neighbours.push_back(tile + tiling.columns);
    return neighbours;
}

/// Fits the anchors' maps to the dots, and learns how dark dots and how light the paper are.
void refine_anchors(const ImageView& scan, const Tiling& tiling, Field& field) {
    std::vector<double> strengths;
    std::vector<double> papers;
    for (int t = 0; t < tiling.count(); ++t) {
        auto& map = field.maps[static_cast<std::size_t>(t)];
        if (!map) continue;
        const SeenTile tile = measure_tile(scan, tiling.rect(t), *map, field.code, std::nullopt);
        auto fitted = fit_map(tile, field.code);
        if (!belongs(tile) || !fitted) {
            map.reset();
            continue;
        }
        map = *fitted;
        strengths.push_back(tile.strength);
        papers.push_back(tile.paper);
    }
    field.strength = median_of(strengths);
    field.paper = median_of(papers);
}

/// The map of a tile, continued from that of its neighbour; nothing if the tile shows no part of the
/// field. First from the dots next to the neighbour, because perspective bends the grid away from
/// where its map leads. With few dots, the neighbour's map is the better one.
std::optional<LocalMap> continued(const ImageView& scan, const Tiling& tiling, const Field& field,
                                  int t, const LocalMap& from) {
    const PixelRect rect = tiling.rect(t);
    const SeenTile part =
        measure_tile(scan, part_near(rect, tiling, from), from, field.code, field.strength);
    if (!belongs(part)) return std::nullopt;
    const LocalMap map = fit_map(part, field.code).value_or(from);
    const SeenTile whole = measure_tile(scan, rect, map, field.code, field.strength);
    if (!belongs(whole)) return map;
    return fit_map(whole, field.code).value_or(map);
}

/// The map by which to look for cells in a tile: its own, or that of a neighbour. A tile that shows
/// only the edge of a field beside other print has none of its own.
const LocalMap* map_for(int tile, const Tiling& tiling, const Field& field) {
    const auto of = [&](int t) -> const LocalMap* {
        const auto& map = field.maps[static_cast<std::size_t>(t)];
        return map ? &*map : nullptr;
    };
    if (of(tile) != nullptr) return of(tile);
    for (const int neighbour : neighbours_of(tile, tiling)) {
        if (of(neighbour) != nullptr) return of(neighbour);
        for (const int corner : neighbours_of(neighbour, tiling)) {
            const bool touches = std::abs(corner % tiling.columns - tile % tiling.columns) <= 1 &&
                                 std::abs(corner / tiling.columns - tile / tiling.columns) <= 1;
            if (touches && of(corner) != nullptr) return of(corner);
        }
    }
    return nullptr;
}

/// The rectangle of cells that the maps of a field can reach.
CellGrid bounding_grid(const Tiling& tiling, const Field& field) {
    Vector2d low = Vector2d::Constant(1e18);
    Vector2d high = -low;
    for (int t = 0; t < tiling.count(); ++t) {
        const LocalMap* map = map_for(t, tiling, field);
        if (map == nullptr) continue;
        const PixelRect rect = tiling.rect(t);
        for (const int u : {rect.u_begin, rect.u_end}) {
            for (const int v : {rect.v_begin, rect.v_end}) {
                const Vector2d cell = map->cell(Vector2d(u, v));
                low = low.cwiseMin(cell - Vector2d::Constant(2));
                high = high.cwiseMax(cell + Vector2d::Constant(2));
            }
        }
    }
    low = low.cwiseMax(Vector2d::Zero());
    high = high.cwiseMin(Vector2d::Constant(kPositionsPerAxis - 1));
    CellGrid grid;
    grid.origin = {static_cast<std::uint32_t>(low.x()), static_cast<std::uint32_t>(low.y())};
    grid.columns = static_cast<int>(high.x() - grid.origin.x) + 1;
    grid.rows = static_cast<int>(high.y() - grid.origin.y) + 1;
    return grid;
}

/// How much of a column or row of cells was looked at, and how much of that reads right.
struct Coverage {
    int seen = 0;
    int dots = 0;
    int right = 0;
};

/// Takes outer columns and rows off a grid until they read right.
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
        bool changed = true;
        while (changed && i_begin_ < i_end_ && j_begin_ < j_end_) {
            changed = false;
            if (!has_column(i_begin_)) changed = true, ++i_begin_;
            if (i_begin_ < i_end_ && !has_column(i_end_ - 1)) changed = true, --i_end_;
            if (!has_row(j_begin_)) changed = true, ++j_begin_;
            if (j_begin_ < j_end_ && !has_row(j_end_ - 1)) changed = true, --j_end_;
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

    /// A few cells of a line that is cut off, or of other print, do not make it a line of dots.
    static bool is_enough(const Coverage& line, int longest) {
        return line.right >= kLeastLineShare * line.seen &&
               line.right >= kLeastRightShare * line.dots && line.right > kLeastLength * longest;
    }
    bool has_column(int i) const { return is_enough(column(i), longest_column_); }
    bool has_row(int j) const { return is_enough(row(j), longest_row_); }

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

std::vector<Field> group_anchors(const std::vector<Anchor>& anchors, const Tiling& tiling) {
    std::vector<Field> fields;
    for (const Anchor& anchor : anchors) {
        auto field = std::ranges::find_if(
            fields, [&](const Field& candidate) { return continues(candidate, anchor); });
        if (field == fields.end()) {
            Field& fresh = fields.emplace_back();
            fresh.code.section = anchor.section;
            fresh.maps.resize(static_cast<std::size_t>(tiling.count()));
            field = fields.end() - 1;
        }
        field->maps[static_cast<std::size_t>(anchor.tile)] = anchor.map;
    }
    return fields;
}

bool follow(const ImageView& scan, const Tiling& tiling, Field& field) {
    refine_anchors(scan, tiling, field);
    std::deque<int> queue;
    for (int t = 0; t < tiling.count(); ++t) {
        if (field.maps[static_cast<std::size_t>(t)]) queue.push_back(t);
    }
    const bool is_borne_out = !queue.empty();
    while (!queue.empty()) {
        const int from = queue.front();
        queue.pop_front();
        const LocalMap map = *field.maps[static_cast<std::size_t>(from)];
        for (const int t : neighbours_of(from, tiling)) {
            auto& there = field.maps[static_cast<std::size_t>(t)];
            if (there) continue;
            there = continued(scan, tiling, field, t, map);
            if (there) queue.push_back(t);
        }
    }
    return is_borne_out;
}

CellGrid collect_cells(const ImageView& scan, const Tiling& tiling, const Field& field) {
    CellGrid grid = bounding_grid(tiling, field);
    const std::size_t count =
        static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
    grid.cells.resize(count);
    std::vector<bool> seen(count);
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            SeenCell& cell = grid.cells[static_cast<std::size_t>(j) *
                                            static_cast<std::size_t>(grid.columns) +
                                        static_cast<std::size_t>(i)];
            cell.x = grid.origin.x + static_cast<std::uint32_t>(i);
            cell.y = grid.origin.y + static_cast<std::uint32_t>(j);
            cell.nominal = field.code.symbol(cell.x, cell.y);
        }
    }
    for (int t = 0; t < tiling.count(); ++t) {
        const LocalMap* map = map_for(t, tiling, field);
        if (map == nullptr) continue;
        const bool is_own = field.maps[static_cast<std::size_t>(t)].has_value();
        const PixelRect rect =
            is_own ? tiling.rect(t) : part_near(tiling.rect(t), tiling, *map);
        const SeenTile tile = measure_tile(scan, rect, *map, field.code, field.strength);
        for (const SeenCell& cell : tile.cells) {
            const std::int64_t i = std::int64_t{cell.x} - grid.origin.x;
            const std::int64_t j = std::int64_t{cell.y} - grid.origin.y;
            if (i < 0 || j < 0 || i >= grid.columns || j >= grid.rows) continue;
            const auto index = static_cast<std::size_t>(j * grid.columns + i);
            // Tiles overlap by a cell: what reads right counts.
            if (!grid.cells[index].is_right()) grid.cells[index] = cell;
            seen[index] = true;
        }
    }
    return Trimmer(grid, seen).trimmed();
}

}  // namespace dotpose::calibrate
