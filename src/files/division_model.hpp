/// The lens of ROS and OpenCV, and the division model (paper eq. 2) that comes nearest to it.
#pragma once

#include "dotpose/files/camera.hpp"

namespace dotpose::files {

/// http://docs.ros.org/en/api/sensor_msgs/html/msg/CameraInfo.html, plumb_bob: the lens of OpenCV,
/// which leads from the undistorted to the distorted image.
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

    /// Where a camera without distortion would see what this one sees at `pixel`; far outside of
    /// any image where that cannot be told.
    PixelPoint undistorted(PixelPoint pixel) const;
};

/// Sets `k_per_px2` and `centre_px` to what is nearest to `lens` all over the image, whose size is
/// known. Returns the misfit in px, rms over the image; infinite if the lens cannot be inverted.
double fit_division_model(const PlumbBob& lens, Camera& camera);

}  // namespace dotpose::files
