/// ROS 2 messages without a dependency on ROS: plain structs with the names and members of the
/// common message packages, together with their serialisation and their text definitions.
///
///     PoseWithCovarianceStamped message;
///     message.header = {ros_time(time_ns), "map"};
///     const std::vector<std::uint8_t> bytes = to_cdr(message);
///
/// robot_messages.hpp creates messages from fixes, and mcap_file.hpp writes messages to files.
/// Units and frames follow ROS REP 103: metres, radians, seconds; x forward, y left, z up.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose::ros {

/// builtin_interfaces/Time
struct Time {
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
};

/// Converts nanoseconds since 1970, or since any other epoch, to a Time message. Out-of-range times
/// are clamped.
Time ros_time(std::int64_t time_ns);

/// std_msgs/Header
struct Header {
    Time stamp;
    std::string frame_id;
};

/// geometry_msgs/Point and geometry_msgs/Vector3
struct Vector3 {
    double x = 0;
    double y = 0;
    double z = 0;
};

/// geometry_msgs/Quaternion
struct Quaternion {
    double x = 0;
    double y = 0;
    double z = 0;
    double w = 1;
};

/// geometry_msgs/Pose
struct Pose {
    Vector3 position;
    Quaternion orientation;
};

/// Covariance of (x, y, z, rotations about x, y and z), row by row.
using Covariance36 = std::array<double, 36>;

/// geometry_msgs/PoseWithCovariance
struct PoseWithCovariance {
    Pose pose;
    Covariance36 covariance{};
};

/// geometry_msgs/PoseWithCovarianceStamped
struct PoseWithCovarianceStamped {
    Header header;
    PoseWithCovariance pose;
};

/// geometry_msgs/Twist
struct Twist {
    Vector3 linear;
    Vector3 angular;
};

/// geometry_msgs/TwistWithCovariance
struct TwistWithCovariance {
    Twist twist;
    Covariance36 covariance{};
};

/// nav_msgs/Odometry: the pose in `header.frame_id`, the twist in `child_frame_id`.
struct Odometry {
    Header header;
    std::string child_frame_id;
    PoseWithCovariance pose;
    TwistWithCovariance twist;
};

/// geometry_msgs/Transform
struct Transform {
    Vector3 translation;
    Quaternion rotation;
};

/// geometry_msgs/TransformStamped: the pose of `child_frame_id` in `header.frame_id`.
struct TransformStamped {
    Header header;
    std::string child_frame_id;
    Transform transform;
};

/// tf2_msgs/TFMessage
struct TFMessage {
    std::vector<TransformStamped> transforms;
};

/// diagnostic_msgs/KeyValue
struct KeyValue {
    std::string key;
    std::string value;
};

/// diagnostic_msgs/DiagnosticStatus
struct DiagnosticStatus {
    std::uint8_t level = 0;  ///< 0: OK, 1: WARN, 2: ERROR, 3: STALE
    std::string name;
    std::string message;
    std::string hardware_id;
    std::vector<KeyValue> values;
};

/// diagnostic_msgs/DiagnosticArray
struct DiagnosticArray {
    Header header;
    std::vector<DiagnosticStatus> status;
};

/// sensor_msgs/CompressedImage
struct CompressedImage {
    Header header;
    std::string format;  ///< "png" or "jpeg"
    std::vector<std::uint8_t> data;
};

/// Serialises a message in the ROS 2 format: a four-byte encapsulation header, followed by
/// little-endian CDR (XCDR1).
std::vector<std::uint8_t> to_cdr(const PoseWithCovarianceStamped& message);
std::vector<std::uint8_t> to_cdr(const Odometry& message);
std::vector<std::uint8_t> to_cdr(const TFMessage& message);
std::vector<std::uint8_t> to_cdr(const DiagnosticArray& message);
std::vector<std::uint8_t> to_cdr(const CompressedImage& message);

/// Name and definition of a message type. They are stored in recordings, so programs without ROS
/// can decode the messages.
struct MessageType {
    std::string name;  ///< such as "geometry_msgs/msg/PoseWithCovarianceStamped"
    /// The .msg definitions of the type and of all types that it contains, in `ros2msg` format.
    std::string definition;
    std::string hash;  ///< "RIHS01_" and 64 hexadecimal digits (ROS REP 2011)
};

/// Returns the type of a message.
const MessageType& type_of(const PoseWithCovarianceStamped& message);
const MessageType& type_of(const Odometry& message);
const MessageType& type_of(const TFMessage& message);
const MessageType& type_of(const DiagnosticArray& message);
const MessageType& type_of(const CompressedImage& message);

}  // namespace dotpose::ros

DOTPOSE_END_EXPORT
