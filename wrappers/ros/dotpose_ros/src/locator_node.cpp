// A ROS 2 component that subscribes to images and camera_info, and publishes poses, odometry,
// transforms and diagnostics. Code that does not depend on ROS is in parameters.hpp and
// robot_locator.hpp.
#include "locator_node.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <type_traits>
#include <variant>

#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>

#include <dotpose/files/error.hpp>

#include "messages.hpp"
#include "parameters.hpp"
#include "robot_locator.hpp"

namespace dotpose_ros {
namespace {

using sensor_msgs::msg::CameraInfo;
using sensor_msgs::msg::Image;

/// Declares a parameter and returns its value. Parameters are read-only, so `ros2 param set` cannot
/// change them. Their types are dynamic, to allow floating-point numbers without a decimal point.
/// `settings_of` checks the types.
Value declare(rclcpp::Node& node, const Parameter& parameter) {
    rcl_interfaces::msg::ParameterDescriptor descriptor;
    descriptor.description = parameter.description;
    descriptor.read_only = true;
    descriptor.dynamic_typing = true;
    const rclcpp::ParameterValue standard = std::visit(
        [](const auto& value) {
            if constexpr (std::is_same_v<decltype(value), const std::monostate&>) {
                return rclcpp::ParameterValue();
            } else {
                return rclcpp::ParameterValue(value);
            }
        },
        parameter.standard);
    const rclcpp::ParameterValue value =
        node.declare_parameter(parameter.name, standard, descriptor);
    switch (value.get_type()) {
        case rclcpp::ParameterType::PARAMETER_NOT_SET:
            return {};
        case rclcpp::ParameterType::PARAMETER_BOOL:
            return value.get<bool>();
        case rclcpp::ParameterType::PARAMETER_INTEGER:
            return value.get<std::int64_t>();
        case rclcpp::ParameterType::PARAMETER_DOUBLE:
            return value.get<double>();
        case rclcpp::ParameterType::PARAMETER_STRING:
            return value.get<std::string>();
        default:
            break;
    }
    throw dotpose::Error(std::string("parameter ") + parameter.name + " must be a single value");
}

Settings declared_settings(rclcpp::Node& node) {
    std::map<std::string, Value> values;
    for (const Parameter& parameter : parameters())
        values[parameter.name] = declare(node, parameter);
    return settings_of(values);
}

/// Returns the quality of service for sensor data: best effort, or reliable if the `reliable`
/// parameter is set.
rclcpp::QoS sensor_quality(const Settings& settings) {
    rclcpp::QoS quality = rclcpp::SensorDataQoS();
    if (settings.is_reliable) quality.reliable();
    return quality;
}

}  // namespace

class LocatorNode : public rclcpp::Node {
  public:
    explicit LocatorNode(const rclcpp::NodeOptions& options) : Node("dotpose", options) {
        const Settings settings = declared_settings(*this);
        locator_.emplace(settings, get_fully_qualified_name());
        add_publishers(settings);
        if (auto mount = locator_->mount(now().nanoseconds()))
            tf_static_->publish(to_ros(dotpose::ros::TFMessage{{*mount}}));
        add_subscriptions(settings);
    }

  private:
    void add_publishers(const Settings& settings) {
        const rclcpp::QoS quality = sensor_quality(settings);
        pose_ = create_publisher<geometry_msgs::msg::PoseWithCovarianceStamped>("~/pose", quality);
        if (locator_->has_space_pose()) {
            camera_ = create_publisher<geometry_msgs::msg::PoseWithCovarianceStamped>(
                "~/camera_pose", quality);
            camera_odometry_ = create_publisher<nav_msgs::msg::Odometry>("~/camera_odom", quality);
        }
        odometry_ = create_publisher<nav_msgs::msg::Odometry>("~/odom", quality);
        if (settings.publishes_tf)
            tf_ = create_publisher<tf2_msgs::msg::TFMessage>("/tf", rclcpp::QoS(100));
        status_ = create_publisher<diagnostic_msgs::msg::DiagnosticArray>("/diagnostics",
                                                                          rclcpp::QoS(10));
        // Intra-process communication is disabled, because it would not deliver the mount to
        // subscribers that start later.
        rclcpp::PublisherOptions kept;
        kept.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
        tf_static_ = create_publisher<tf2_msgs::msg::TFMessage>(
            "/tf_static", rclcpp::QoS(1).transient_local(), kept);
    }

    void add_subscriptions(const Settings& settings) {
        const rclcpp::QoS quality = sensor_quality(settings);
        image_ = create_subscription<Image>("image", quality,
                                            [this](Image::ConstSharedPtr image) { take(*image); });
        if (settings.has_camera_file) return;
        // The subscription is kept as long as the node exists, because the executor of ROS Jazzy
        // stops calling callbacks if a callback destroys its own subscription.
        camera_info_ = create_subscription<CameraInfo>(
            "camera_info", quality, [this](CameraInfo::ConstSharedPtr info) { take(*info); });
    }

    void take(const CameraInfo& info) {
        Lens lens{info.width, info.height, info.distortion_model, {}, info.d};
        std::ranges::copy(info.k, lens.k.begin());
        warn(locator_->take(lens));
    }

    void take(const Image& image) {
        const std::int64_t arrival_ns =
            std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
        const RobotLocator::Answer answer = locator_->take(
            {image.encoding, image.width, image.height, image.step, image.is_bigendian != 0,
             image.data},
            nanoseconds(image.header.stamp.sec, image.header.stamp.nanosec), arrival_ns);
        warn(answer.warning);
        const dotpose::ros::RobotMessages& messages = answer.messages;
        if (messages.pose) pose_->publish(to_ros(*messages.pose));
        if (messages.camera && camera_) camera_->publish(to_ros(*messages.camera));
        if (messages.camera_odometry && camera_odometry_)
            camera_odometry_->publish(to_ros(*messages.camera_odometry));
        if (messages.odometry) odometry_->publish(to_ros(*messages.odometry));
        if (messages.tf && tf_) tf_->publish(to_ros(*messages.tf));
        if (!messages.status.status.empty()) status_->publish(to_ros(messages.status));
    }

    void warn(const std::string& text) {
        if (!text.empty()) RCLCPP_WARN(get_logger(), "%s", text.c_str());
    }

    std::optional<RobotLocator> locator_;
    rclcpp::Publisher<geometry_msgs::msg::PoseWithCovarianceStamped>::SharedPtr pose_;
    rclcpp::Publisher<geometry_msgs::msg::PoseWithCovarianceStamped>::SharedPtr camera_;
    rclcpp::Publisher<nav_msgs::msg::Odometry>::SharedPtr camera_odometry_;
    rclcpp::Publisher<nav_msgs::msg::Odometry>::SharedPtr odometry_;
    rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr tf_;
    rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr tf_static_;
    rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr status_;
    rclcpp::Subscription<Image>::SharedPtr image_;
    rclcpp::Subscription<CameraInfo>::SharedPtr camera_info_;
};

std::shared_ptr<rclcpp::Node> make_locator_node(const rclcpp::NodeOptions& options) {
    return std::make_shared<LocatorNode>(options);
}

}  // namespace dotpose_ros

RCLCPP_COMPONENTS_REGISTER_NODE(dotpose_ros::LocatorNode)
