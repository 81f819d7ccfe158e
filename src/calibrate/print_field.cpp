#include "calibrate/print_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>

#include "calibrate/print_fit.hpp"
#include "calibrate/print_light.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// Anchors belong to one field if their cells agree to this number of cells plus this share of the
/// distance between them: paper stretches, and cameras see it in perspective.
constexpr double kAgree_cells = 1.5;
constexpr double kAgreeShare = 0.05;
/// Least number of dots that must read right in a tile of a field; kLeastRightShare of all must,
/// too.
constexpr int kLeastRight = 12;

/// Returns the map of `field` in the tile nearest to a point; null if it has none.
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

bool continues(const Field& field, const Section& section, const LocalMap& other) {
    if (!(field.code.section.u == section.u && field.code.section.v == section.v)) return false;
    const LocalMap* map = nearest_map(field, other.centre_px);
    if (map == nullptr) return false;
    const Vector2d expected = map->cell(other.centre_px);
    const double distance = (expected - map->centre_cell).norm();
    return (expected - other.centre_cell).norm() <= kAgree_cells + kAgreeShare * distance;
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

/// Fits the existing maps to the dots, and sets the darkness of dots and the level of the paper.
void refine_maps(const ImageView& scan, const Tiling& tiling, Field& field) {
    std::vector<double> papers;
    for (int t = 0; t < tiling.count(); ++t) {
        auto& map = field.maps[static_cast<std::size_t>(t)];
        if (!map) continue;
        const SeenTile tile = measure_tile(scan, tiling.rect(t), *map, field.code, std::nullopt);
        auto fitted = fit_map(tile, field.code, field.perspective);
        if (!belongs(tile) || !fitted) {
            map.reset();
            continue;
        }
        map = *fitted;
        field.strengths[static_cast<std::size_t>(t)] = tile.strength;
        papers.push_back(tile.paper);
    }
    field.paper = median_of(papers);
}

/// Extends the map of a neighbour into a tile. Returns false if the tile shows no part of the
/// field. The map is first fitted to the dots next to the neighbour, because a tilted camera or a
/// bent lens leads the grid away from the neighbour's map. With few dots, the neighbour's map is
/// better.
bool continue_into(int t, int from, const ImageView& scan, const Tiling& tiling, Field& field) {
    const PixelRect rect = tiling.rect(t);
    const LocalMap& beside = *field.maps[static_cast<std::size_t>(from)];
    double& strength = field.strengths[static_cast<std::size_t>(t)];
    strength = field.strengths[static_cast<std::size_t>(from)];
    const SeenTile part =
        measure_tile(scan, part_near(rect, tiling, beside), beside, field.code, strength);
    if (!belongs(part)) return false;
    LocalMap map = fit_map(part, field.code, field.perspective).value_or(beside);
    const SeenTile whole = measure_tile(scan, rect, map, field.code, strength);
    if (belongs(whole)) {
        map = fit_map(whole, field.code, field.perspective).value_or(map);
        strength = whole.strength;
    }
    field.maps[static_cast<std::size_t>(t)] = map;
    return true;
}

/// Extends the grid from tile to tile.
void spread(const ImageView& scan, const Tiling& tiling, Field& field) {
    std::deque<int> queue;
    for (int t = 0; t < tiling.count(); ++t) {
        if (field.maps[static_cast<std::size_t>(t)]) queue.push_back(t);
    }
    while (!queue.empty()) {
        const int from = queue.front();
        queue.pop_front();
        for (const int t : neighbours_of(from, tiling)) {
            if (field.maps[static_cast<std::size_t>(t)]) continue;
            if (continue_into(t, from, scan, tiling, field)) queue.push_back(t);
        }
    }
}

/// Returns the perspective of the whole page, from the maps; none if lengths hardly differ across
/// it.
Perspective perspective_of(const Field& field) {
    constexpr double kNotable = 0.003;
    std::vector<Match> places;
    Vector2d low = Vector2d::Constant(1e18);
    Vector2d high = -low;
    for (const auto& map : field.maps) {
        if (!map) continue;
        low = low.cwiseMin(map->centre_cell);
        high = high.cwiseMax(map->centre_cell);
        constexpr double kStep_cells = 6;
        for (const Vector2d& step :
             {Vector2d(1, 1), Vector2d(1, -1), Vector2d(-1, 1), Vector2d(-1, -1)}) {
            const Vector2d cell = map->centre_cell + kStep_cells * step;
            places.push_back({cell, map->pixel(cell)});
        }
    }
    constexpr std::size_t kLeastPlaces = 12;
    if (places.size() < kLeastPlaces) return {};
    const PlaneFit fit = fit_plane(places, ViewModel::perspective);
    if (fit.perspective_per_mm.norm() * (high - low).norm() < kNotable) return {};
    return {fit.centre_mm, fit.perspective_per_mm};
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
        auto field = std::ranges::find_if(fields, [&](const Field& candidate) {
            return continues(candidate, anchor.section, anchor.map);
        });
        if (field == fields.end()) {
            Field& fresh = fields.emplace_back();
            fresh.code.section = anchor.section;
            fresh.maps.resize(static_cast<std::size_t>(tiling.count()));
            fresh.strengths.resize(fresh.maps.size());
            field = fields.end() - 1;
        }
        field->maps[static_cast<std::size_t>(anchor.tile)] = anchor.map;
    }
    return fields;
}

bool take_over(Field& field, Field& other) {
    bool has_gained = false;
    for (std::size_t t = 0; t < other.maps.size(); ++t) {
        auto& map = other.maps[t];
        if (!map || !continues(field, other.code.section, *map)) continue;
        if (!field.maps[t]) {
            field.maps[t] = map;
            has_gained = true;
        }
        map.reset();
    }
    return has_gained;
}

bool follow(const ImageView& scan, const Tiling& tiling, Field& field) {
    refine_maps(scan, tiling, field);
    if (std::ranges::none_of(field.maps, [](const auto& map) { return map.has_value(); })) {
        return false;
    }
    spread(scan, tiling, field);
    field.perspective = perspective_of(field);
    if (field.perspective.per_cell.norm() > 0) {
        for (auto& map : field.maps) {
            if (map) map->perspective_per_cell = field.perspective.at(map->centre_cell);
        }
        refine_maps(scan, tiling, field);
        spread(scan, tiling, field);
    }
    field.strengths = smooth_strengths(field, tiling);
    return true;
}

}  // namespace dotpose::calibrate
