#include "core/pose/facing_dots.hpp"

#include <cmath>

#include "core/pose/dot_offsets.hpp"
#include "core/pose/tuning.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {
namespace {

/// Calls use(first, second, direction) for each pair of facing dots. `direction` is the unit vector
/// from the first dot to the second.
template <typename Use>
void visit_facing(const MeasuredDots& dots, Use use) {
    const auto is_at = [&](std::size_t k, float column, float row, Symbol symbol) {
        return dots.column[k] == column && dots.row[k] == row &&
               static_cast<Symbol>(dots.bits[k]) == symbol;
    };
    std::size_t above = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        const float column = dots.column[k];
        const float row = dots.row[k];
        const auto symbol = static_cast<Symbol>(dots.bits[k]);
        if (symbol == Symbol::left && k > 0 && is_at(k - 1, column - 1, row, Symbol::right))
            use(k - 1, k, FloatVec{1, 0});
        if (symbol != Symbol::up) continue;
        while (dots.row[above] < row - 1 ||
               (dots.row[above] == row - 1 && dots.column[above] < column))
            ++above;
        if (is_at(above, column, row - 1, Symbol::down)) use(above, k, FloatVec{0, 1});
    }
}

}  // namespace

bool correct_neighbour_bias(const FloatPlane& plane, const PoseFit& fit, MeasuredDots& dots) {
    const float limit = tuning::fit::kOutlier * fit.variance;
    float sum = 0;
    float count = 0;
    visit_facing(dots, [&](std::size_t first, std::size_t second, FloatVec direction) {
        if (dots.x[first] >= kNoDot_px || dots.x[second] >= kNoDot_px) return;
        const DotOffset a = dot_offset(dots, first, plane, fit.displacement);
        const DotOffset b = dot_offset(dots, second, plane, fit.displacement);
        if (!(a.squared() <= limit && b.squared() <= limit)) return;
        sum += direction.x * (b.residual.x - a.residual.x) +
               direction.y * (b.residual.y - a.residual.y);
        count += 2;
    });
    if (!(sum > tuning::facing::kSure * std::sqrt(count * fit.variance))) return false;
    const float bias = sum / count;
    const float by = bias / (plane.du_x * plane.dv_y - plane.dv_x * plane.du_y);
    visit_facing(dots, [&](std::size_t first, std::size_t second, FloatVec direction) {
        const FloatVec apart_px{by * (direction.x * plane.dv_y - direction.y * plane.dv_x),
                                by * (direction.y * plane.du_x - direction.x * plane.du_y)};
        if (dots.x[first] < kNoDot_px) {
            dots.x[first] -= apart_px.x;
            dots.y[first] -= apart_px.y;
        }
        if (dots.x[second] < kNoDot_px) {
            dots.x[second] += apart_px.x;
            dots.y[second] += apart_px.y;
        }
    });
    return true;
}

}  // namespace dotpose::core
