// The residuals of a frame's observations, and their derivatives.
#pragma once

#include <cmath>

#include "calibrate/map_solver.hpp"

namespace dotpose::calibrate {

/// A frame at its current pose. All vectors are in the camera frame, unless stated otherwise.
class MapView {
  public:
    MapView(const MapGrid& grid, const MapFrame& frame, double reach_mm)
        : grid_(grid), frame_(frame), reach_mm_(reach_mm) {
        rotation_ << std::cos(frame.angle_rad), -std::sin(frame.angle_rad),
            std::sin(frame.angle_rad), std::cos(frame.angle_rad);
    }

    const Eigen::Matrix2d& page_from_camera() const { return rotation_; }

    /// Returns the observed position of a dot minus the position expected from the pose and the
    /// displacement of the frame. Ignores the view terms and the offset of the dot.
    Eigen::Vector2d residual(const MapObservation& seen) const {
        const Eigen::Vector2d target = grid_.place_mm(seen.index(), frame_.displacement_mm);
        return Eigen::Vector2d(seen.x_mm, seen.y_mm) -
               rotation_.transpose() * (target - frame_.place_mm);
    }

    /// Position (x, y) of an observation, in units of `reach_mm`, and the direction in which its
    /// dot is displaced. The derivatives of the residual depend only on these values.
    struct Terms {
        double x;
        double y;
        Eigen::Vector2d direction;

        /// Returns the change in the residual for given changes in the parameters. `frame` contains
        /// the changes in position, angle and displacement. `shared` is the sum of the view terms
        /// of the frame and the terms of the camera.
        Eigen::Vector2d change(const FrameVector& frame, const CameraVector& shared) const {
            const double scale =
                shared[0] + shared[3] * x + shared[4] * y + shared[5] * (x * x + y * y);
            return {frame[0] - frame[2] * y + x * (scale + shared[1]) + y * shared[2] -
                        frame[3] * direction.x(),
                    frame[1] + frame[2] * x + y * (scale - shared[1]) + x * shared[2] -
                        frame[3] * direction.y()};
        }
        /// Multiplies the transposed derivatives by `g`. Adds the result for the parameters of the
        /// frame to `frame`, and the result for the lens distortion to `distortion`.
        void add_transposed(const Eigen::Vector2d& g, FrameVector& frame,
                            double& distortion) const {
            const double along = x * g.x() + y * g.y();
            frame[0] += g.x();
            frame[1] += g.y();
            frame[2] += x * g.y() - y * g.x();
            frame[3] -= direction.dot(g);
            frame[4] += along;
            frame[5] += x * g.x() - y * g.y();
            frame[6] += y * g.x() + x * g.y();
            frame[7] += x * along;
            frame[8] += y * along;
            distortion += (x * x + y * y) * along;
        }
        Eigen::Matrix<double, 2, kFrameTerms> derivatives() const {
            Eigen::Matrix<double, 2, kFrameTerms> result;
            result << 1, 0, -y, -direction.x(), x, x, y, x * x, x * y,  //
                0, 1, x, -direction.y(), y, -y, x, x * y, y * y;
            return result;
        }
    };
    Terms terms(const MapObservation& seen) const {
        const auto& [dx, dy] = grid_.directions[seen.index()];
        return {double(seen.x_mm) / reach_mm_, double(seen.y_mm) / reach_mm_,
                rotation_.transpose() * Eigen::Vector2d(dx, dy)};
    }

  private:
    const MapGrid& grid_;
    const MapFrame& frame_;
    double reach_mm_;
    Eigen::Matrix2d rotation_;
};

/// Adds the prior on the view terms to `block`, the matrix of the normal equations of a frame.
/// `variance` is the factor by which the equations have been multiplied. The prior makes `block`
/// invertible even if the dots of the frame do not determine all terms.
inline void add_view_prior(const MapSolution& solution, double variance, FrameBlock& block) {
    for (int k = 0; k < kViewTerms; ++k) {
        const double sigma = solution.view_sigma[static_cast<std::size_t>(k)];
        block(4 + k, 4 + k) += variance / (sigma * sigma);
    }
    block.diagonal().array() += 1e-9 * block.diagonal().maxCoeff();
}

/// Returns the sum of the view terms of a frame and the terms of the camera.
inline CameraVector shared_terms(const FrameVector& frame, const CameraVector& camera) {
    CameraVector shared = camera;
    shared.head<kViewTerms>() += frame.tail<kViewTerms>();
    return shared;
}

}  // namespace dotpose::calibrate
