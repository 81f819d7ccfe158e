/// Converts the lens model of ROS and OpenCV to the nearest division model (equation 2 of the
/// paper).
#pragma once

#include "dotpose/files/camera.hpp"

namespace dotpose::files {

/// Lens model of OpenCV. Maps undistorted to distorted positions. This is the plumb_bob model of
/// http://docs.ros.org/en/api/sensor_msgs/html/msg/CameraInfo.html.
struct PlumbBob {
    double fx = 0;
    double fy = 0;
    double cx = 0;
    double cy = 0;
    double k1 = 0;
    double k2 = 0;
    double t1 = 0;
    double t2 = 0;
    double k3 = 0;

    bool is_straight() const { return k1 == 0 && k2 == 0 && t1 == 0 && t2 == 0 && k3 == 0; }

    /// Returns the undistorted position of `pixel`, or a point far outside any image if the
    /// iteration does not converge.
    PixelPoint undistorted(PixelPoint pixel) const;
};

/// Sets `k_per_px2` and `centre_px` of `camera` to the division model nearest to `lens` over the
/// image. Sets `camera.pinhole` to the pinhole camera that, combined with this model, has the same
/// viewing directions as `lens`. The image size must be set. Returns the rms difference between the
/// two models over the image, in px, or infinity if the lens cannot be inverted.
double fit_division_model(const PlumbBob& lens, Camera& camera);

}  // namespace dotpose::files
