/// Sends the readings of `dotpose watch` as ROS 2 messages to an MCAP file and over DDS.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "capture/frame_source.hpp"
#include "dds/publisher.hpp"
#include "dotpose/tools/image_file.hpp"
#include "reading.hpp"
#include "robot_recording.hpp"

namespace dotpose::cli {

struct RobotOutputOptions {
    std::string mcap;         ///< MCAP file to record, or empty for none
    bool has_images = false;  ///< true to record the images as well
    ImageEncoding image_format = ImageEncoding::png;
    std::optional<dds::PublisherOptions> dds;  ///< none if nothing is published over DDS
    std::string robot;
    std::string frame_prefix;      ///< prefix of the names of the robot's frames of reference
    std::optional<Camera> camera;  ///< source of the mount and the exposure time
    /// True if the run fits poses of the camera in space. The mount of the camera is then not sent.
    bool has_space_pose = false;

    bool is_wanted() const { return !mcap.empty() || dds; }
};

/// Computes the time stamps of messages, in ns. A live frame has the time of the end of its
/// exposure on the monotonic clock. ROS expects the middle of the exposure on the system clock, so
/// this time is converted. The times of recorded frames are used unchanged.
class Stamps {
  public:
    explicit Stamps(double exposure_us) : half_exposure_ns_(std::llround(exposure_us * 500)) {}
    std::int64_t of(const capture::Frame& frame);

  private:
    std::int64_t half_exposure_ns_;
    std::optional<std::int64_t>
        system_from_monotonic_ns_;  ///< constant, to preserve the intervals between frames
};

class RobotOutput {
  public:
    /// Throws Error if the file or the publisher cannot be opened.
    explicit RobotOutput(const RobotOutputOptions& options);

    /// Sends the messages of a frame. Throws Error.
    void take(const capture::Frame& frame, const Reading& reading);

    /// Replaces the camera. The new mount is sent with the next frame.
    void set_camera(const Camera& camera);

    /// Completes the file and reports the number of published messages. Throws Error.
    void finish();

  private:
    RobotOutputOptions options_;
    Stamps stamps_;
    ros::RobotMessenger messenger_;
    bool sends_mount_;  ///< true if the mount is sent with the next frame
    std::optional<RobotRecording> recording_;
    std::optional<dds::Publisher> publisher_;
};

}  // namespace dotpose::cli
