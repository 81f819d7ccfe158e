// Publishes the messages of a robot to ROS 2 directly over DDS. Uses the same topics, types and
// quality-of-service settings as ROS nodes, but does not require ROS. Requires Eclipse Cyclone DDS
// at build time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dotpose/tools/robot_messages.hpp"

namespace dotpose::dds {

struct PublisherOptions {
    int domain = 0;  ///< ROS_DOMAIN_ID
    /// True to resend poses that a subscriber did not receive. If false, the publisher is
    /// best-effort, and subscribers that request reliable delivery (the default in ROS) receive no
    /// poses.
    bool is_reliable = false;
    /// True to limit discovery to this computer, like ROS with
    /// ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST.
    bool is_local = false;
    bool has_space_pose = false;  ///< true to publish poses of the camera in space
};

class Publisher {
  public:
    /// `robot` must be valid as part of a ROS topic name. Throws BadArgument if this program was
    /// built without DDS, and Error if DDS cannot be set up.
    Publisher(const std::string& robot, const PublisherOptions& options);
    /// Waits up to 1 s for all subscribers to receive the messages on reliable topics.
    ~Publisher();
    Publisher(const Publisher&) = delete;
    Publisher& operator=(const Publisher&) = delete;

    /// Publishes the messages for a frame. Each reliable topic keeps its newest 100 messages for
    /// slow subscribers. If `waits` is true, waits up to 10 s for slow subscribers before newer
    /// messages replace messages that have not been received.
    void publish(const ros::RobotMessages& messages, bool waits);
    /// Publishes the mount of the camera. Subscribers that connect later also receive the mount.
    void publish(const ros::TransformStamped& mount);

    /// Returns the number of messages that were passed to DDS.
    std::int64_t sent() const;
    /// Returns the number of messages lost because DDS had no space for them or a subscriber did
    /// not receive them within 10 s.
    std::int64_t dropped() const;

  private:
    class Writers;
    std::unique_ptr<Writers> writers_;
};

}  // namespace dotpose::dds
