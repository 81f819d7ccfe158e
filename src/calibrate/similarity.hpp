// Fits the position, angle and scale of the camera frame on the page to the dots in an image.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// A dot: its position in the camera frame, and its intersection on the page.
struct SimilarPoint {
    Eigen::Vector2d seen;
    Eigen::Vector2d intersection;
    Eigen::Vector2d direction;  ///< unit vector in the direction of the dot's displacement
};

struct Similarity {
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< origin of the camera frame on the page
    double angle_rad = 0;
    double scale = 1;
    double displacement = 0;
};

/// Fits intersection + displacement * direction = place + scale * R(angle) * seen by least squares.
/// Points whose residuals exceed four standard deviations are not used.
Similarity fit_similarity(const std::vector<SimilarPoint>& points);

}  // namespace dotpose::calibrate
