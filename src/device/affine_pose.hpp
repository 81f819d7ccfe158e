// Affine pose: the pose from all dots, in integers, for a camera that looks straight at the paper
// and whose lens does not distort, or is corrected for. Devices without floating point stop here;
// others continue with refine_pose.hpp.
#pragma once

#include "core/pose/observations.hpp"
#include "core/stages.hpp"

namespace dotpose::core {

/// Fits the map from the dots' centres to the places where the code has them printed; dots that are
/// farther off than most are left out. Returns the number of dots used, or 0 if they do not
/// determine the map, which then stays as it was. Sets `displacement_q16`, the distance of the
/// typical dot from its intersection in spacings.
int fit_affine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                    std::int32_t& displacement_q16);

}  // namespace dotpose::core
