// Definitions of the message types as text, in the format of ROS 2 .msg files (ros2msg). A
// definition consists of the type itself, followed by the types that it contains. Each contained
// type is preceded by a line of equal signs.
#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "dotpose/files/error.hpp"
#include "dotpose/tools/ros_messages.hpp"

namespace dotpose::ros {
namespace {

struct Definition {
    std::string_view package;
    std::string_view name;
    std::string_view members;  ///< definitions of the members, one per line
};

constexpr std::string_view kXyz = "float64 x\nfloat64 y\nfloat64 z\n";

constexpr std::array kDefinitions = {
    Definition{"builtin_interfaces", "Time", "int32 sec\nuint32 nanosec\n"},
    Definition{"std_msgs", "Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    Definition{"geometry_msgs", "Point", kXyz},
    Definition{"geometry_msgs", "Vector3", kXyz},
    Definition{"geometry_msgs", "Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    Definition{"geometry_msgs", "Pose",
               "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    Definition{"geometry_msgs", "PoseWithCovariance",
               "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    Definition{"geometry_msgs", "PoseWithCovarianceStamped",
               "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"},
    Definition{"geometry_msgs", "Twist",
               "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    Definition{"geometry_msgs", "TwistWithCovariance",
               "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    Definition{"nav_msgs", "Odometry",
               "std_msgs/Header header\nstring child_frame_id\n"
               "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist\n"},
    Definition{"geometry_msgs", "Transform",
               "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    Definition{"geometry_msgs", "TransformStamped",
               "std_msgs/Header header\nstring child_frame_id\n"
               "geometry_msgs/Transform transform\n"},
    Definition{"tf2_msgs", "TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    Definition{"diagnostic_msgs", "KeyValue", "string key\nstring value\n"},
    Definition{"diagnostic_msgs", "DiagnosticStatus",
               "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
               "byte level\nstring name\nstring message\nstring hardware_id\n"
               "diagnostic_msgs/KeyValue[] values\n"},
    Definition{"diagnostic_msgs", "DiagnosticArray",
               "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"},
    Definition{"sensor_msgs", "CompressedImage",
               "std_msgs/Header header\nstring format\nuint8[] data\n"},
};

const Definition& definition(std::string_view full_name) {
    const auto found = std::ranges::find_if(kDefinitions, [full_name](const Definition& each) {
        return full_name == std::string(each.package) + '/' + std::string(each.name);
    });
    if (found == kDefinitions.end()) throw Error("no message type " + std::string(full_name));
    return *found;
}

/// Appends the names of all types that occur in `members`, without duplicates.
void collect(std::string_view members, std::vector<std::string>& names) {
    std::istringstream lines{std::string(members)};
    std::string type;
    for (std::string member; lines >> type >> member;) {
        type = type.substr(0, type.find('['));
        const bool is_plain = type.find('/') == std::string::npos;
        if (is_plain || std::ranges::find(names, type) != names.end()) continue;
        names.push_back(type);
        collect(definition(type).members, names);
    }
}

MessageType message_type(std::string_view full_name, std::string_view sha256) {
    const Definition& whole = definition(full_name);
    MessageType type{std::string(whole.package) + "/msg/" + std::string(whole.name),
                     std::string(whole.members), "RIHS01_" + std::string(sha256)};
    std::vector<std::string> parts;
    collect(whole.members, parts);
    for (const std::string& part : parts) {
        type.definition += std::string(80, '=') + "\nMSG: " + part + '\n';
        type.definition += definition(part).members;
    }
    return type;
}

}  // namespace

const MessageType& type_of(const PoseWithCovarianceStamped&) {
    static const MessageType type =
        message_type("geometry_msgs/PoseWithCovarianceStamped",
                     "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e");
    return type;
}

const MessageType& type_of(const Odometry&) {
    static const MessageType type = message_type(
        "nav_msgs/Odometry", "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
    return type;
}

const MessageType& type_of(const TFMessage&) {
    static const MessageType type = message_type(
        "tf2_msgs/TFMessage", "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
    return type;
}

const MessageType& type_of(const DiagnosticArray&) {
    static const MessageType type =
        message_type("diagnostic_msgs/DiagnosticArray",
                     "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e");
    return type;
}

const MessageType& type_of(const CompressedImage&) {
    static const MessageType type =
        message_type("sensor_msgs/CompressedImage",
                     "15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a");
    return type;
}

}  // namespace dotpose::ros
