// The map from pixels to the code plane or to the paper that a fix defines, with Eigen types.
#pragma once

#include <Eigen/Core>

#include "base/plane_map.hpp"

namespace dotpose::calibrate {

/// Map from a pixel to a position in the pattern:
///
///   at + linear q / (1 + perspective . q + lens |q|^2)
///
/// where q = pixel - centre_px.
struct FixPlane {
    FixPlane() = default;
    explicit FixPlane(const PlaneFromImage& fixed) {
        const PlaneMap map(fixed);
        centre_px = Eigen::Vector2d(map.centre_px.data());
        at = Eigen::Vector2d(map.at_centre.data());
        linear << map.du[0], map.dv[0], map.du[1], map.dv[1];
        perspective = Eigen::Vector2d(map.perspective.data());
        lens = map.lens;
    }

    /// Returns the position to which the pixel centre_px + q is mapped.
    Eigen::Vector2d place(const Eigen::Vector2d& q) const {
        return at + linear * q / (1 + perspective.dot(q) + lens * q.squaredNorm());
    }

    Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
    Eigen::Vector2d perspective = Eigen::Vector2d::Zero();
    double lens = 0;
};

}  // namespace dotpose::calibrate
