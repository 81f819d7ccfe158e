// Fields: contiguous regions of the code in a scan, and where they lie.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_anchors.hpp"
#include "calibrate/print_dots.hpp"

namespace dotpose::calibrate {

/// Of the dots of a region that are seen, this share at least reads right. A quarter would by
/// chance; half of them in another region if its columns happen to agree.
inline constexpr double kLeastRightShare = 0.7;

/// One region of the code in the scan: which tiles show it, and where.
struct Field {
    Code code;
    std::vector<std::optional<LocalMap>> maps;  ///< for each tile
    std::vector<double> strengths;              ///< darkness to be expected of a dot in each tile
    double paper = 0;                           ///< median grey level of the paper
    Perspective perspective;                    ///< of the maps; none on scans
};

/// Anchors that continue each other become one field each.
std::vector<Field> group_anchors(const std::vector<Anchor>& anchors, const Tiling& tiling);

/// Takes those tiles away from another field that continue this one. True if they show parts of
/// the page that this one had not reached: it has to be followed once more.
bool take_over(Field& field, Field& other);

/// Carries the grid from the anchored tiles on into their neighbours, as far as dots go on reading
/// right, and fits all maps to the dots, in the perspective of the whole page. False if no dots
/// bear the anchors out.
bool follow(const ImageView& scan, const Tiling& tiling, Field& field);

/// The part of a tile in which a map of a tile beside it can be trusted.
PixelRect part_near(const PixelRect& rect, const Tiling& tiling, const LocalMap& map);

}  // namespace dotpose::calibrate
