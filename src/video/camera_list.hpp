// Finds the cameras of this computer (V4L2) and what they can do.
#pragma once

#include <string>
#include <vector>

namespace dotpose::video {

/// A size of the frames of a camera, with the rates and formats in which it delivers them.
struct CameraSize {
    std::string size;                  ///< such as "640x480", or a range of sizes
    std::vector<double> rates;         ///< frames per second, the highest first; empty if not told
    std::vector<std::string> formats;  ///< such as "YUYV" and "MJPG"
};

struct FoundCamera {
    std::string device;  ///< such as "/dev/video0"
    std::string name;    ///< as its driver calls it
    std::vector<CameraSize> sizes;
    std::string problem;  ///< why nothing else is known of it; empty if it could be asked
};

/// Asks all of /dev/video0 to /dev/video63, and leaves out devices that are no cameras. An empty
/// list means that there is none.
std::vector<FoundCamera> find_cameras();

/// Returns the cameras in a sentence without a full stop: "cameras are /dev/video0 (name), ...", or
/// that none was found.
std::string in_one_line(const std::vector<FoundCamera>& cameras);

}  // namespace dotpose::video
