#include "calibrate/print_field.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

#include "calibrate/median.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// Two tiles belong to the same field if their maps predict nearly the same position, in cells, for
/// the same pixel. The positions may differ by kAgree_cells plus kAgreeFraction times the distance
/// between the centres of the tiles in cells, because paper stretches and a camera adds
/// perspective.
constexpr double kAgree_cells = 1.5;
constexpr double kAgreeFraction = 0.05;

using Group = std::vector<LocatedTile>;

/// Returns true if the map of a tile agrees with the map of the nearest tile in a group.
bool continues(const Group& group, const LocatedTile& tile) {
    if (group.front().section != tile.section) return false;
    const auto distance_px2 = [&](const LocatedTile& other) {
        return (other.map.centre_px - tile.map.centre_px).squaredNorm();
    };
    const TileMap& map = std::ranges::min_element(group, {}, distance_px2)->map;
    const Vector2d expected = map.cell(tile.map.centre_px);
    const double distance = (expected - map.centre_cell).norm();
    return (expected - tile.map.centre_cell).norm() <= kAgree_cells + kAgreeFraction * distance;
}

Field field_of(const Group& group, const Tiling& tiling) {
    Field field;
    field.code.section = group.front().section;
    field.tiles.resize(static_cast<std::size_t>(tiling.count()));
    std::vector<double> papers;
    for (const LocatedTile& tile : group) {
        field.tiles[static_cast<std::size_t>(tile.tile)] = tile;
        papers.push_back(tile.levels.paper);
    }
    field.paper = upper_median(std::move(papers));
    return field;
}

}  // namespace

std::vector<Field> join_tiles(const LocatedTiles& tiles) {
    std::vector<Group> groups;
    for (const LocatedTile& tile : tiles.located) {
        const auto same = std::ranges::stable_partition(
            groups, [&](const Group& group) { return !continues(group, tile); });
        Group joined;
        for (Group& group : same) {
            if (joined.empty()) {
                joined = std::move(group);
            } else {
                joined.insert(joined.end(), group.begin(), group.end());
            }
        }
        joined.push_back(tile);
        groups.erase(same.begin(), same.end());
        groups.push_back(std::move(joined));
    }
    std::ranges::stable_sort(groups, std::ranges::greater{}, &Group::size);
    std::vector<Field> fields;
    for (const Group& group : groups)
        fields.push_back(field_of(group, tiles.tiling));
    return fields;
}

}  // namespace dotpose::calibrate
