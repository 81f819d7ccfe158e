/// Records a robot's messages to an MCAP file, with the topic names used in ROS.
#pragma once

#include <optional>
#include <string>

#include "dotpose/tools/mcap_file.hpp"
#include "dotpose/tools/robot_messages.hpp"

namespace dotpose::cli {

struct RobotTopics {
    explicit RobotTopics(const std::string& robot);

    std::string pose;
    std::string camera;
    std::string odometry;
    std::string camera_odometry;
    std::string status;
    std::string image;
    static constexpr const char* kTf = "/tf";
    static constexpr const char* kTfStatic = "/tf_static";
};

/// Converts the name of a robot to a valid ROS name, which consists of letters, digits and
/// underscores and does not begin with a digit.
std::string ros_name(const std::string& robot);

class RobotRecording {
  public:
    /// Throws Error if the file cannot be created.
    RobotRecording(const std::string& path, const std::string& robot);

    /// Records the messages for a frame. Throws Error on failure.
    void take(const ros::RobotMessages& messages, std::int64_t time_ns);
    /// Record the camera mount or an image. Throw Error on failure.
    void take_mount(const ros::TransformStamped& mount, std::int64_t time_ns);
    void take_image(const ros::CompressedImage& image, std::int64_t time_ns);

    /// Finishes and closes the file. Throws Error on failure.
    void finish() { file_.finish(); }

  private:
    template <typename Message>
    void write(std::optional<McapChannel>& channel, const std::string& topic,
               const Message& message, std::int64_t time_ns);

    McapFile file_;
    RobotTopics topics_;
    // Each channel is created when its first message is recorded.
    std::optional<McapChannel> poses_;
    std::optional<McapChannel> cameras_;
    std::optional<McapChannel> odometry_;
    std::optional<McapChannel> camera_odometry_;
    std::optional<McapChannel> tf_;
    std::optional<McapChannel> tf_static_;
    std::optional<McapChannel> status_;
    std::optional<McapChannel> images_;
};

}  // namespace dotpose::cli
