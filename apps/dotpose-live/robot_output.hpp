/// Converts the readings of `dotpose watch` to ROS 2 messages. Writes the messages to an MCAP
/// file and publishes them over DDS.
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
    std::string mcap;         ///< path of the MCAP file, or empty to write no file
    bool has_images = false;  ///< true to record images as well
    ImageEncoding image_format = ImageEncoding::png;
    std::optional<dds::PublisherOptions> dds;  ///< nullopt if nothing is published over DDS
    std::string robot;
    std::string frame_prefix;      ///< prefix for the names of the robot's coordinate frames
    std::optional<Camera> camera;  ///< provides the mount and the exposure time
    /// True if the run computes camera poses in space. If so, the camera mount is not sent.
    bool has_space_pose = false;

    bool is_wanted() const { return !mcap.empty() || dds; }
};

/// Computes the time stamps of messages, in ns. The time of a live frame is taken at the end of the
/// exposure, on the monotonic clock. ROS expects the time of the middle of the exposure, on the
/// system clock, so the time is converted. The times of recorded frames are not changed.
class Stamps {
  public:
    explicit Stamps(double exposure_us) : half_exposure_ns_(std::llround(exposure_us * 500)) {}
    std::int64_t of(const capture::Frame& frame);

  private:
    std::int64_t half_exposure_ns_;
    /// System time minus monotonic time. Computed only once, to preserve the intervals between
    /// frames.
    std::optional<std::int64_t> system_from_monotonic_ns_;
};

class RobotOutput {
  public:
    /// Throws Error if the file or the publisher cannot be opened.
    explicit RobotOutput(const RobotOutputOptions& options);

    /// Writes and publishes the messages for a frame. Throws Error on failure.
    void take(const capture::Frame& frame, const Reading& reading);

    /// Replaces the camera. Its mount is sent with the next frame.
    void set_camera(const Camera& camera);

    /// Finishes the file and reports the number of published messages. Throws Error on failure.
    void finish();

  private:
    RobotOutputOptions options_;
    Stamps stamps_;
    ros::RobotMessenger messenger_;
    bool sends_mount_;  ///< true to send the mount with the next frame
    std::optional<RobotRecording> recording_;
    std::optional<dds::Publisher> publisher_;
};

}  // namespace dotpose::cli
