// Lists the local cameras (V4L2) and their capabilities.
#pragma once

#include <string>
#include <vector>

namespace dotpose::video {

/// A frame size that a camera supports, and the frame rates and pixel formats that are available
/// for it.
struct CameraSize {
    std::string size;           ///< for example "640x480", or a range of sizes
    std::vector<double> rates;  ///< frames per second in descending order, or empty if unknown
    std::vector<std::string> formats;  ///< for example "YUYV" and "MJPG"
};

struct FoundCamera {
    std::string device;  ///< for example "/dev/video0"
    std::string name;    ///< name reported by the driver
    std::vector<CameraSize> sizes;
    /// Reason why the device could not be queried, or empty if it was queried.
    std::string problem;
};

/// Returns the cameras among /dev/video0 to /dev/video63, or an empty list if there are none.
std::vector<FoundCamera> find_cameras();

/// Lists the cameras in a sentence without a full stop: "cameras are /dev/video0 (name), ...". If
/// there are no cameras, the sentence says that none were found.
std::string in_one_line(const std::vector<FoundCamera>& cameras);

}  // namespace dotpose::video
