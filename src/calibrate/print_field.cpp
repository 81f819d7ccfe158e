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
/// A tile belongs to a field if so many of its dots, and kLeastRightShare of all, read right.
constexpr int kLeastRight = 12;

/// The map of the tile in `field` that is nearest to a point, if any.
const LocalMap* nearest_map(const Field& field, const Vector2d& pixel) {
    const LocalMap* nearest = nullptr;
    for (const auto& map : field.maps) {
        if (!map) continue;
        if (nearest == nullptr ||
            (map->centre_px - pixel).squaredNorm() < (nearest->centre_px - pixel).squaredNorm()) {
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

/// The map of a tile, continued from that of its neighbour; nothing if the tile shows no part of
/// the field. First from the dots next to the neighbour, because perspective bends the grid away
/// from where its map leads. With few dots, the neighbour's map is the better one.
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

}  // namespace

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

}  // namespace dotpose::calibrate
