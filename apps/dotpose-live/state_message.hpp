/// Messages of robots as JSON by VDA 5050, version 2.0.0: poses on the topic `visualization`, and
/// whether a robot is connected on the topic `connection`. docs/live.md describes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "publish/mqtt.hpp"

namespace dotpose::cli {

/// Prefix of the topics of all robots, which are kTopicRoot/ROBOT/SUBJECT.
inline constexpr const char* kTopicRoot = "uagv/v2/dotpose";

/// Values of `connectionState`, in the order of publish::Presence.
inline constexpr std::string_view kConnectionStates[] = {"ONLINE", "OFFLINE", "CONNECTIONBROKEN"};

/// Longest name of a robot; topics with longer names are ignored.
inline constexpr std::size_t kMaxNameBytes = 128;

/// Subject of a message, the last part of its topic.
enum class Subject {
    visualization,  ///< a RobotState
    connection,     ///< a RobotConnection, retained by the broker
};

std::string topic_of(const std::string& robot, Subject subject);

/// Sender and subject of a message. The name is a part of the topic.
struct MessageTopic {
    std::string_view robot;
    Subject subject = Subject::visualization;
};

/// Parses a topic. Brokers grant rights by topic, so the sender is taken from the topic and not
/// from the message. Returns none if `topic_of` does not make this topic, or if the name is too
/// long.
std::optional<MessageTopic> parse_topic(std::string_view topic);

struct RobotState {
    std::string robot;            ///< name of the sender; empty in a message that was parsed
    std::uint64_t header_id = 0;  ///< counts the robot's messages
    std::int64_t sent_us = 0;     ///< microseconds since 1970, system clock of the sender
    std::string state = "lost";   ///< lost, moving, stationary
    bool is_localized = false;    ///< whether the members below are valid
    std::string map_id;           ///< name of the plane that x and y refer to
    double x_m = 0;
    double y_m = 0;
    double theta_rad = 0;
    double deviation_m = 0;
    double vx_m_s = 0;
    double vy_m_s = 0;
    double omega_rad_s = 0;
};

/// Returns the message of the subject `visualization`.
std::string json_of(const RobotState& state);

/// Parses such a message. Returns none if it is not valid or its numbers are out of range.
std::optional<RobotState> parse_state(std::string_view json);

struct RobotConnection {
    std::string robot;            ///< name of the sender; empty in a message that was parsed
    std::uint64_t header_id = 0;  ///< counts these messages of the robot
    std::int64_t sent_us = 0;     ///< as in RobotState; of a last will, when the robot connected
    publish::Presence presence = publish::Presence::online;
};

/// Returns the message of the subject `connection`.
std::string json_of(const RobotConnection& connection);

/// Parses such a message. Returns none if it is not valid.
std::optional<RobotConnection> parse_connection(std::string_view json);

/// Returns the system time in microseconds since 1970.
std::int64_t system_us();

}  // namespace dotpose::cli
