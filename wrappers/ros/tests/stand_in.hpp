/// Replacement for ROS 2, which Debian does not package. Declares the messages and the parts of
/// rclcpp that the node uses. The declarations follow the ROS documentation. With these
/// declarations, the node can be compiled but not run. Each ROS header that the node includes is
/// replaced with a generated file that includes stand_in.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <dotpose/tools/ros_messages.hpp>

// The messages below have the same members as the ROS messages. The test
// robots.Cdr.TypesAreDefinedAsInRos checks this.
namespace std_msgs::msg {
using dotpose::ros::Header;
}
namespace geometry_msgs::msg {
using dotpose::ros::PoseWithCovariance;
using dotpose::ros::PoseWithCovarianceStamped;
using dotpose::ros::Quaternion;
using dotpose::ros::TransformStamped;
}  // namespace geometry_msgs::msg
namespace nav_msgs::msg {
using dotpose::ros::Odometry;
}
namespace tf2_msgs::msg {
using dotpose::ros::TFMessage;
}
namespace diagnostic_msgs::msg {
using dotpose::ros::DiagnosticArray;
using dotpose::ros::DiagnosticStatus;
using dotpose::ros::KeyValue;
}  // namespace diagnostic_msgs::msg

namespace sensor_msgs::msg {
struct Image {
    using ConstSharedPtr = std::shared_ptr<const Image>;
    std_msgs::msg::Header header;
    std::uint32_t height;
    std::uint32_t width;
    std::string encoding;
    std::uint8_t is_bigendian;
    std::uint32_t step;
    std::vector<std::uint8_t> data;
};
struct CameraInfo {
    using ConstSharedPtr = std::shared_ptr<const CameraInfo>;
    std::uint32_t height;
    std::uint32_t width;
    std::string distortion_model;
    std::vector<double> d;
    std::array<double, 9> k;
};
}  // namespace sensor_msgs::msg

namespace rcl_interfaces::msg {
struct ParameterDescriptor {
    std::string description;
    bool read_only;
    bool dynamic_typing;
};
}  // namespace rcl_interfaces::msg

namespace rclcpp {

class NodeOptions {};

class QoS {
  public:
    explicit QoS(std::size_t depth);
    QoS& reliable();
    QoS& transient_local();
};
class SensorDataQoS : public QoS {
  public:
    SensorDataQoS();
};

enum class IntraProcessSetting { Enable, Disable, NodeDefault };
struct PublisherOptions {
    IntraProcessSetting use_intra_process_comm;
};

enum ParameterType : std::uint8_t {
    PARAMETER_NOT_SET,
    PARAMETER_BOOL,
    PARAMETER_INTEGER,
    PARAMETER_DOUBLE,
    PARAMETER_STRING,
    PARAMETER_BYTE_ARRAY,
};
class ParameterValue {
  public:
    ParameterValue();
    explicit ParameterValue(bool value);
    explicit ParameterValue(std::int64_t value);
    explicit ParameterValue(double value);
    explicit ParameterValue(const std::string& value);
    ParameterType get_type() const;
    template <typename Type>
    const Type& get() const;
};

class Time {
  public:
    std::int64_t nanoseconds() const;
};
class Logger {};

template <typename Message>
class Publisher {
  public:
    using SharedPtr = std::shared_ptr<Publisher>;
    void publish(const Message& message);
};
template <typename Message>
class Subscription {
  public:
    using SharedPtr = std::shared_ptr<Subscription>;
};

class Node {
  public:
    Node(const std::string& name, const NodeOptions& options);
    const char* get_fully_qualified_name() const;
    Logger get_logger() const;
    Time now() const;

    const ParameterValue& declare_parameter(
        const std::string& name, const ParameterValue& standard,
        const rcl_interfaces::msg::ParameterDescriptor& descriptor);

    template <typename Message>
    typename Publisher<Message>::SharedPtr create_publisher(const std::string& topic,
                                                            const QoS& quality,
                                                            const PublisherOptions& options = {});
    template <typename Message, typename Callback>
    typename Subscription<Message>::SharedPtr create_subscription(const std::string&, const QoS&,
                                                                  Callback&& callback) {
        // Checks that rclcpp would accept the callback.
        std::function<void(typename Message::ConstSharedPtr)> checked =
            std::forward<Callback>(callback);
        return nullptr;
    }
};

void init(int argc, const char* const* argv);
void spin(std::shared_ptr<Node> node);
bool shutdown();

}  // namespace rclcpp

/// Checks that the arguments match the format string, as the rclcpp macro does.
[[gnu::format(printf, 1, 2)]] void stand_in_log(const char* format, ...);
#define RCLCPP_WARN(logger, ...) (static_cast<void>(logger), stand_in_log(__VA_ARGS__))

/// Checks that the component can be constructed from NodeOptions.
#define RCLCPP_COMPONENTS_REGISTER_NODE(type) \
    static_assert(std::is_constructible_v<type, const rclcpp::NodeOptions&>);
