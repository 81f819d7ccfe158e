// Affine pose: the pose from all dots, in integers, for a camera that looks straight at the paper
// through a lens that does not bend, or whose bend was taken out. Devices without floating point
// stop here; others continue with refine_pose.hpp.
#pragma once

#include "core/pose/observations.hpp"
#include "core/stages.hpp"

namespace dotpose::core {

/// Least squares from the dots' centres to the places where the code has them printed; dots farther
/// off than most are left out. Returns the number of dots used; 0, with the pose as it was, when
/// they do not determine it. `displacement_q16`: of the typical dot from its intersection,
/// spacings.
int fit_affine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                    std::int32_t& displacement_q16);

}  // namespace dotpose::core
