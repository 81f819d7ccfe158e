/// Converts the lens of ROS and OpenCV to the nearest division model (paper eq. 2).
#pragma once

#include "dotpose/files/camera.hpp"

namespace dotpose::files {

/// The lens model of OpenCV, which maps the undistorted to the distorted image; plumb_bob in
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

    /// Returns the undistorted position of `pixel`, or a point far outside any image if it cannot
    /// be computed.
    PixelPoint undistorted(PixelPoint pixel) const;
};

/// Sets `k_per_px2` and `centre_px` to the model nearest to `lens` over the image, whose size must
/// be set. Returns the misfit in px, rms over the image; infinite if the lens cannot be inverted.
double fit_division_model(const PlumbBob& lens, Camera& camera);

}  // namespace dotpose::files
