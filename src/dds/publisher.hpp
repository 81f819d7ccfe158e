// Publishes a robot's messages to ROS 2, over DDS: the topics, types and qualities of service that
// its nodes expect, without ROS. Built with Eclipse Cyclone DDS where that is found.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dotpose/tools/robot_messages.hpp"

namespace dotpose::dds {

struct PublisherOptions {
    int domain = 0;  ///< ROS_DOMAIN_ID
    /// Whether lost poses are sent again. A subscriber that asks for that (the default of ROS) does
    /// not get anything from a publisher that does not.
    bool is_reliable = false;
};

class Publisher {
  public:
    /// `robot` is a name that ROS allows in topics. Throws BadArgument if this program was built
    /// without DDS, Error if DDS cannot be set up.
    Publisher(const std::string& robot, const PublisherOptions& options);
    /// Waits a short time until readers have what was sent reliably.
    ~Publisher();
    Publisher(const Publisher&) = delete;
    Publisher& operator=(const Publisher&) = delete;

    /// Publishes the messages of a frame.
    void publish(const ros::RobotMessages& messages);
    /// Publishes where the camera sits, also for readers that come later.
    void publish(const ros::TransformStamped& mount);

    /// Number of messages that were handed to DDS, and of those it had no room for.
    std::int64_t sent() const;
    std::int64_t dropped() const;

  private:
    class Writers;
    std::unique_ptr<Writers> writers_;
};

}  // namespace dotpose::dds
