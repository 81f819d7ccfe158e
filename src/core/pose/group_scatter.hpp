// Group scatter: estimates how strongly the residuals of neighbouring dots are correlated. Uses a
// one-way analysis of variance over both coordinates.
#pragma once

#include <algorithm>
#include <cmath>

namespace dotpose::core {

/// Sums over groups of neighbouring dots. Residuals are relative to a plane fitted to all dots, and
/// squares are in spacings^2.
struct GroupScatter {
    float squares = 0;  ///< summed squared residuals of all dots
    /// Sum of n |m|^2 over all groups, where n is the number of dots in a group and m their mean
    /// residual.
    float between = 0;
    float dots = 0;
    float groups = 0;

    /// Returns the degrees of freedom of the group means: two coordinates for each group, minus the
    /// number of fitted parameters.
    float freedom() const {
        constexpr float kFitted = 6;
        return std::max(2 * groups - kFitted, 1.0F);
    }
    /// Returns the variance of a dot about its group mean, for one coordinate.
    float variance_within() const {
        constexpr float kExact = 1e-12F;
        return std::max(squares - between, 0.0F) / std::max(2 * (dots - groups), 1.0F) + kExact;
    }
    /// Returns by how many standard deviations the scatter between groups exceeds the value that is
    /// expected for uncorrelated residuals.
    float excess() const {
        return (between / (freedom() * variance_within()) - 1) * std::sqrt(freedom() / 2);
    }
    /// Returns the variance of the displacement that all dots of a group have in common, along one
    /// axis.
    float variance_between() const {
        return std::max(between - freedom() * variance_within(), 0.0F) / std::max(2 * dots, 1.0F);
    }
};

}  // namespace dotpose::core
