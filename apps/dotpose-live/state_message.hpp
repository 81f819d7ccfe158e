/// JSON messages from robots according to VDA 5050, version 2.0.0: poses on the `visualization`
/// topic, and the connection state on the `connection` topic (docs/live.md). Also defines the
/// alerts that `dotpose fleet` publishes (docs/fleet.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dotpose/status.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "dotpose/tools/space_track.hpp"
#include "publish/mqtt.hpp"

namespace dotpose::cli {

/// Prefix of all robot topics. A topic has the form kTopicRoot/ROBOT/SUBJECT.
inline constexpr const char* kTopicRoot = "uagv/v2/dotpose";

/// Prefix of all alert topics. A topic has the form kAlertRoot/ROBOT. Alert topics are not below
/// kTopicRoot. A broker can therefore allow each robot to publish below kTopicRoot/ROBOT without
/// also allowing it to publish alerts.
inline constexpr const char* kAlertRoot = "dotpose/alerts";

/// Values of `connectionState`, indexed by publish::Presence.
inline constexpr std::string_view kConnectionStates[] = {"ONLINE", "OFFLINE", "CONNECTIONBROKEN"};

/// Maximum length of the name of a robot, in bytes. Topics with longer names are ignored.
inline constexpr std::size_t kMaxNameBytes = 128;

/// Subject of a message, which is the last level of its topic.
enum class Subject {
    visualization,  ///< a RobotState
    connection,     ///< a RobotConnection, retained by the broker
};

std::string topic_of(const std::string& robot, Subject subject);

/// Sender and subject of a message.
struct MessageTopic {
    std::string_view robot;
    Subject subject = Subject::visualization;
};

/// Parses a topic. Returns nullopt if it does not have the form of `topic_of`, or if the name is
/// longer than kMaxNameBytes. The name of the sender is taken from the topic rather than the
/// message, because brokers can restrict the topics of a client but not the contents of its
/// messages.
std::optional<MessageTopic> parse_topic(std::string_view topic);

/// Value of RobotState::reason if the frame was located but its sheet has no world pose.
inline constexpr std::string_view kNoPlace = "no_place";

/// Numbers of refused frames, indexed by Status. The last element is for Status::other.
using RefusedFrames = std::array<std::uint64_t, kStatusCount + 1>;

/// Frame rate of a robot's camera, and its frame counts since the robot's program was started.
struct CameraReport {
    double rate_hz = 0;  ///< mean frame rate since the previous report
    std::uint64_t frames = 0;
    RefusedFrames refused{};  ///< numbers of frames without a fix (0 for Status::ok)
};

/// Conversion factor from metres (used in messages) to millimetres (used in reports).
inline constexpr double kMm_per_m = 1000;

struct RobotState {
    std::string robot;            ///< name of the sender, or empty in a parsed message
    std::uint64_t header_id = 0;  ///< sequence number of the message
    std::int64_t sent_us = 0;     ///< microseconds since 1970, on the system clock of the sender
    std::string state = "lost";   ///< lost, moving or stationary
    /// Reason why the robot is lost: the name of the Status of its newest frame, or kNoPlace. Empty
    /// if the robot is not lost or the reason is unknown.
    std::string reason;
    std::string sheet;                   ///< name of the sheet in view, or empty if unknown
    std::optional<CameraReport> camera;  ///< included about once per second
    bool is_localized = false;           ///< true if the members below are valid
    std::string map_id;                  ///< name of the map in which x and y are given
    double x_m = 0;
    double y_m = 0;
    double theta_rad = 0;
    double deviation_m = 0;
    double vx_m_s = 0;
    double vy_m_s = 0;
    double omega_rad_s = 0;
    /// Pose of the camera in space, in the frame of the map. In a parsed message, this is the pose
    /// of the tracked camera if available, and the pose has no covariance.
    std::optional<CameraInWorld> camera_pose;
    /// Motion of the tracked camera, in the frame of the map. Not set by `parse_state`.
    std::optional<CameraMotion> camera_track;
};

/// Returns the message with the subject `visualization`.
std::string json_of(const RobotState& state);

/// Parses a message with the subject `visualization`. Returns nullopt if the message is invalid or
/// any of its numbers is out of range.
std::optional<RobotState> parse_state(std::string_view json);

struct RobotConnection {
    std::string robot;            ///< name of the sender, or empty in a parsed message
    std::uint64_t header_id = 0;  ///< sequence number of the connection message
    /// Time at which the message was sent, in microseconds since 1970 on the system clock of the
    /// sender. In the last will of a robot, this is the time at which the robot connected.
    std::int64_t sent_us = 0;
    publish::Presence presence = publish::Presence::online;
};

/// Returns the message with the subject `connection`.
std::string json_of(const RobotConnection& connection);

/// Parses a message with the subject `connection`. Returns nullopt if the message is invalid.
std::optional<RobotConnection> parse_connection(std::string_view json);

/// Alert that a robot has entered or left a condition that requires attention.
struct RobotAlert {
    std::string robot;
    std::uint64_t header_id = 0;
    std::int64_t sent_us = 0;
    std::string_view condition;  ///< moving, still, lost, silent, gone or removed
    std::string_view previous;   ///< condition before the change, or empty for a new robot
    std::string reason;          ///< may be empty
    std::string map_id;          ///< last known map, or empty if unknown
    std::string sheet;
    double x_m = 0;
    double y_m = 0;
};

/// Returns the message with the topic kAlertRoot/ROBOT.
std::string json_of(const RobotAlert& alert);

/// Formats a time, in microseconds since 1970, as it appears in messages:
/// "2026-11-24T16:20:00.123456Z".
std::string timestamp(std::int64_t time_us);

/// Parses a time in the format of `timestamp`, with any number of decimals. Returns nullopt for any
/// other text.
std::optional<std::int64_t> parse_timestamp(std::string_view text);

/// Returns the system time in microseconds since 1970.
std::int64_t system_us();

}  // namespace dotpose::cli
