// Group scatter: estimates how strongly the residuals of neighbouring dots are correlated, by a
// one-way analysis of variance over both coordinates.
#pragma once

#include <algorithm>
#include <cmath>

namespace dotpose::core {

/// Sums over groups of neighbouring dots. Residuals are relative to a plane fitted to all dots, and
/// squares are in spacings^2.
struct GroupScatter {
    float squares = 0;  ///< summed squared residuals of all dots
    /// Sum of n |m|^2 over all groups, where n is the number of dots in a group and m is their mean
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
    /// Returns the variance of a dot's residual about the mean residual of its group, for one
    /// coordinate.
    float variance_within() const {
        constexpr float kExact = 1e-12F;
        return std::max(squares - between, 0.0F) / std::max(2 * (dots - groups), 1.0F) + kExact;
    }
    /// Returns how far the scatter between groups exceeds its expected value for uncorrelated
    /// residuals, in standard deviations of this scatter. The result is negative if the scatter is
    /// smaller than expected.
    float excess() const {
        return (between / (freedom() * variance_within()) - 1) * std::sqrt(freedom() / 2);
    }
    /// Returns the variance, along one axis, of the displacement that is common to all dots in a
    /// group.
    float variance_between() const {
        return std::max(between - freedom() * variance_within(), 0.0F) / std::max(2 * dots, 1.0F);
    }
};

}  // namespace dotpose::core
