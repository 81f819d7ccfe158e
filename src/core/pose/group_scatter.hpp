// Group scatter: whether neighbouring dots are off their places in common. A one-way analysis of
// variance of both coordinates at once.
#pragma once

#include <algorithm>
#include <cmath>

namespace dotpose::core {

/// Sums over groups of neighbouring dots, about a plane that was fitted to all dots, in spacings^2.
struct GroupScatter {
    float squares = 0;  ///< of the dots' residuals
    float between = 0;  ///< of the groups' mean residuals, each times its dots
    float dots = 0;
    float groups = 0;

    /// Returns the degrees of freedom of the groups' means: two coordinates each, less the
    /// parameters of the fit.
    float freedom() const {
        constexpr float kFitted = 6;
        return std::max(2 * groups - kFitted, 1.0F);
    }
    /// Returns the variance of one coordinate of a dot about the mean of its group.
    float variance_within() const {
        constexpr float kExact = 1e-12F;
        return std::max(squares - between, 0.0F) / std::max(2 * (dots - groups), 1.0F) + kExact;
    }
    /// Returns by how many deviations the groups are off more than chance explains.
    float excess() const {
        return (between / (freedom() * variance_within()) - 1) * std::sqrt(freedom() / 2);
    }
    /// Returns the variance, along one axis, of the displacement that the dots of a group share.
    float variance_between() const {
        return std::max(between - freedom() * variance_within(), 0.0F) / std::max(2 * dots, 1.0F);
    }
};

}  // namespace dotpose::core
