// Bounding box of the points in a drawing.
#pragma once

#include <algorithm>
#include <limits>

#include "draw/svg.hpp"

namespace dotpose::draw {

/// Smallest axis-aligned box that contains all added points. If no point was added, `low` is above
/// `high`.
struct Bounds {
    Point low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    Point high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};

    void add(Point p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    bool is_empty() const { return low.x > high.x; }
    double extent() const { return std::max(high.x - low.x, high.y - low.y); }
};

}  // namespace dotpose::draw
