// Publishes a robot's messages to ROS 2 over DDS, with the topics, types and qualities of service
// of ROS nodes but without ROS. Needs Eclipse Cyclone DDS at build time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dotpose/tools/robot_messages.hpp"

namespace dotpose::dds {

struct PublisherOptions {
    int domain = 0;  ///< ROS_DOMAIN_ID
    /// Whether lost poses are sent again. A subscriber that requests this (the default of ROS)
    /// receives nothing from a best-effort publisher.
    bool is_reliable = false;
    /// Whether discovery is limited to this computer, as in ROS with
    /// ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST.
    bool is_local = false;
};

class Publisher {
  public:
    /// `robot` must be a valid ROS topic name. Throws BadArgument if this program was built without
    /// DDS, Error if DDS cannot be set up.
    Publisher(const std::string& robot, const PublisherOptions& options);
    /// Waits a short time for reliable readers.
    ~Publisher();
    Publisher(const Publisher&) = delete;
    Publisher& operator=(const Publisher&) = delete;

    /// Publishes the messages of a frame. With `waits`, waits up to 10 s for slow subscribers of
    /// reliable messages; otherwise the newest 100 messages of a topic are kept for them.
    void publish(const ros::RobotMessages& messages, bool waits);
    /// Publishes the mount of the camera, also for later readers.
    void publish(const ros::TransformStamped& mount);

    /// Number of messages passed to DDS, and number of messages that DDS had no room for or that a
    /// subscriber did not receive within 10 s.
    std::int64_t sent() const;
    std::int64_t dropped() const;

  private:
    class Writers;
    std::unique_ptr<Writers> writers_;
};

}  // namespace dotpose::dds
