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
    /// Whether only programs of this computer are found and served, as nodes of ROS with
    /// ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST do.
    bool is_local = false;
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

    /// Publishes the messages of a frame. With `waits`, it waits up to 10 s for subscribers of
    /// reliable messages that fall behind; otherwise the newest 100 messages of a topic are kept
    /// for them.
    void publish(const ros::RobotMessages& messages, bool waits);
    /// Publishes where the camera sits, also for readers that come later.
    void publish(const ros::TransformStamped& mount);

    /// Number of messages that were handed to DDS, and of those that it had no room for or that a
    /// subscriber did not receive in 10 s.
    std::int64_t sent() const;
    std::int64_t dropped() const;

  private:
    class Writers;
    std::unique_ptr<Writers> writers_;
};

}  // namespace dotpose::dds
