/// Sends the readings of `dotpose watch` as messages of ROS 2: to an MCAP file, and over DDS.
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
    std::string mcap;         ///< file to record; empty for none
    bool has_images = false;  ///< whether the frames are recorded too
    ImageEncoding image_format = ImageEncoding::png;
    std::optional<dds::PublisherOptions> dds;  ///< none if nothing is published
    std::string robot;
    std::string frame_prefix;      ///< before the names of the robot's frames
    std::optional<Camera> camera;  ///< has the mount and the exposure

    bool is_wanted() const { return !mcap.empty() || dds; }
};

/// Gives frames the stamps of their messages, in nanoseconds. Live frames have times on the
/// monotonic clock, of the end of the exposure; other nodes of ROS use the system's clock, and the
/// middle of the exposure. Times of recorded frames stay as they are.
class Stamps {
  public:
    explicit Stamps(double exposure_us) : half_exposure_ns_(std::llround(exposure_us * 500)) {}
    std::int64_t of(const capture::Frame& frame);

  private:
    std::int64_t half_exposure_ns_;
    std::optional<std::int64_t>
        system_from_monotonic_ns_;  ///< constant, so that intervals are kept
};

class RobotOutput {
  public:
    /// Throws Error if something cannot be opened.
    explicit RobotOutput(const RobotOutputOptions& options);

    /// Passes on a frame. Throws Error.
    void take(const capture::Frame& frame, const Reading& reading);

    /// Completes the file, and says how many messages were published. Throws Error.
    void finish();

  private:
    RobotOutputOptions options_;
    Stamps stamps_;
    ros::RobotMessenger messenger_;
    bool has_mount_ = false;  ///< whether the mount was passed on
    std::optional<RobotRecording> recording_;
    std::optional<dds::Publisher> publisher_;
};

}  // namespace dotpose::cli
