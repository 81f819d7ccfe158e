// Print fields: contiguous regions of the code in a scan, and where they lie.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_anchors.hpp"
#include "calibrate/print_dots.hpp"

namespace dotpose::calibrate {

/// Least share of the dots of a region that must read right. A quarter would by chance, and half of
/// them in another region if its columns happen to agree.
inline constexpr double kLeastRightShare = 0.7;

/// One region of the code in the scan, and its place in each tile that shows it.
struct Field {
    Code code;
    std::vector<std::optional<LocalMap>> maps;  ///< by tile
    std::vector<double> strengths;              ///< expected darkness of a dot, by tile
    double paper = 0;                           ///< median grey level of the paper
    Perspective perspective;                    ///< perspective of the maps; none on scans
};

/// Groups anchors that continue each other into fields.
std::vector<Field> group_anchors(const std::vector<Anchor>& anchors, const Tiling& tiling);

/// Moves the tiles of another field that continue this one into this one. Returns whether they show
/// parts of the page that this field had not reached, so that it must be followed again.
bool take_over(Field& field, Field& other);

/// Extends the grid from the anchored tiles into their neighbours, as far as dots read right, and
/// fits all maps to the dots, in the perspective of the whole page. Returns false if no dots
/// confirm the anchors.
bool follow(const ImageView& scan, const Tiling& tiling, Field& field);

/// Returns the part of a tile in which the map of a neighbouring tile can be trusted.
PixelRect part_near(const PixelRect& rect, const Tiling& tiling, const LocalMap& map);

}  // namespace dotpose::calibrate
