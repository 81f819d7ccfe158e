// Finds the cameras of this computer (V4L2) and their capabilities.
#pragma once

#include <string>
#include <vector>

namespace dotpose::video {

/// A frame size of a camera, with its rates and formats.
struct CameraSize {
    std::string size;                  ///< such as "640x480", or a range of sizes
    std::vector<double> rates;         ///< frames per second, the highest first; empty if not known
    std::vector<std::string> formats;  ///< such as "YUYV" and "MJPG"
};

struct FoundCamera {
    std::string device;  ///< such as "/dev/video0"
    std::string name;    ///< name reported by its driver
    std::vector<CameraSize> sizes;
    std::string problem;  ///< reason why the device could not be queried; empty if it could
};

/// Returns the cameras among /dev/video0 to /dev/video63; empty if there are none.
std::vector<FoundCamera> find_cameras();

/// Returns the cameras in a sentence without a full stop: "cameras are /dev/video0 (name), ...", or
/// that none was found.
std::string in_one_line(const std::vector<FoundCamera>& cameras);

}  // namespace dotpose::video
