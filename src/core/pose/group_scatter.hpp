// Group scatter: the correlation of the residuals of neighbouring dots, estimated by a one-way
// analysis of variance of both coordinates together.
#pragma once

#include <algorithm>
#include <cmath>

namespace dotpose::core {

/// Sums over groups of neighbouring dots. Residuals are relative to a plane that was fitted to all
/// dots. Squares are in spacings^2.
struct GroupScatter {
    float squares = 0;  ///< sum of the squared residuals of all dots
    /// Sum, over all groups, of the squared mean residual times the number of dots of the group.
    float between = 0;
    float dots = 0;
    float groups = 0;

    /// Returns the degrees of freedom of the group means: two coordinates per group, minus the
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
    /// Returns the excess of the scatter between groups over chance, in standard deviations.
    float excess() const {
        return (between / (freedom() * variance_within()) - 1) * std::sqrt(freedom() / 2);
    }
    /// Returns the variance, along one axis, of the displacement that is common to the dots of a
    /// group.
    float variance_between() const {
        return std::max(between - freedom() * variance_within(), 0.0F) / std::max(2 * dots, 1.0F);
    }
};

}  // namespace dotpose::core
