#include "dotpose/tools/outcome.hpp"

#include <cmath>
#include <numbers>

#include "dotpose/files/degrees.hpp"

namespace dotpose {

Deviation deviation_of(const Fix& fix, const Truth& truth) {
    return {fix.x_grid() - truth.x_grid, fix.y_grid() - truth.y_grid,
            std::remainder(fix.theta_rad() - truth.theta_rad, 2 * std::numbers::pi)};
}

bool Outcome::is_wrong() const {
    if (!is_fix()) return false;
    if (!truth.has_pose) return true;
    const Deviation off = deviation_of(fix, truth);
    return std::hypot(off.x_grid, off.y_grid) > kWrongFrom_grid ||
           std::abs(off.theta_rad) * kDegrees > kWrongFrom_deg ||
           (truth.section && fix.section != *truth.section);
}

}  // namespace dotpose
