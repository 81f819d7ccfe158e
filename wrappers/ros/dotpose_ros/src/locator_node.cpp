// A component of ROS 2: images and camera_info in; poses, odometry, transforms and diagnostics out.
// All that it knows of dots, frames and covariances is in the library dotpose.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <sensor_msgs/msg/camera_info.hpp>
#include <sensor_msgs/msg/image.hpp>

#include <dotpose/files/camera_file.hpp>
#include <dotpose/files/sheet_file.hpp>
#include <dotpose/tools/follower.hpp>
#include <dotpose/tools/robot_messages.hpp>

#include "messages.hpp"

namespace dotpose_ros {

using sensor_msgs::msg::CameraInfo;
using sensor_msgs::msg::Image;

namespace {

struct TemporaryFolder {
    std::filesystem::path path;
    ~TemporaryFolder() {
        std::error_code failed;
        std::filesystem::remove_all(path, failed);
    }
};

/// Reads the lens from a camera_info as from a file of that format. Throws dotpose::Error.
dotpose::Camera camera_of(const CameraInfo& info) {
    std::string name = (std::filesystem::temp_directory_path() / "dotpose-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw dotpose::Error("cannot create a temporary folder");
    const TemporaryFolder folder{name};
    const std::filesystem::path file_name = folder.path / "camera_info.yaml";
    const auto write = [](std::ostream& file, const char* key, const auto& values) {
        file << key << ": [";
        for (std::size_t i = 0; i < values.size(); ++i)
            file << (i > 0 ? ", " : "") << values[i];
        file << "]\n";
    };
    {
        std::ofstream file(file_name);
        file.precision(17);
        file << "width: " << info.width << "\nheight: " << info.height
             << "\ndistortion_model: " << info.distortion_model << '\n';
        write(file, "k", info.k);
        write(file, "d", info.d);
    }
    return dotpose::read_camera(file_name);
}

}  // namespace

class LocatorNode : public rclcpp::Node {
  public:
    explicit LocatorNode(const rclcpp::NodeOptions& node_options)
        : Node("dotpose", node_options), messenger_(get_name(), frames()) {
        const std::string sheets = declare_parameter("sheets", "");
        const std::string camera = declare_parameter("camera", "");
        options_.spacing_mm = declare_parameter("spacing_mm", options_.spacing_mm);
        options_.track.max_speed_mm_s = static_cast<float>(
            1000 *
            declare_parameter("max_speed_m_s", double{options_.track.max_speed_mm_s} / 1000));
        options_.track.acceleration_mm_s2 = static_cast<float>(
            1000 * declare_parameter("acceleration_m_s2",
                                     double{options_.track.acceleration_mm_s2} / 1000));
        half_exposure_ns_ = static_cast<std::int64_t>(500 * declare_parameter("exposure_us", 0.0));
        if (!sheets.empty()) options_.sheets = dotpose::read_sheets(sheets);
        if (!camera.empty()) options_.camera = dotpose::read_camera(camera);
        follower_.emplace(options_);
        add_publishers();
        add_subscriptions(camera.empty());
    }

  private:
    dotpose::ros::RobotFrames frames() {
        dotpose::ros::RobotFrames frames;
        frames.map = declare_parameter("map_frame", frames.map);
        frames.odom = declare_parameter("odom_frame", frames.odom);
        frames.base = declare_parameter("base_frame", frames.base);
        return frames;
    }

    void add_publishers() {
        // Sensor data is sent best effort, unless the parameter says otherwise.
        rclcpp::QoS quality = rclcpp::SensorDataQoS();
        if (declare_parameter("reliable", false)) quality.reliable();
        pose_ = create_publisher<geometry_msgs::msg::PoseWithCovarianceStamped>("~/pose", quality);
        odometry_ = create_publisher<nav_msgs::msg::Odometry>("~/odom", quality);
        if (declare_parameter("publish_tf", true)) {
            tf_ = create_publisher<tf2_msgs::msg::TFMessage>("/tf", rclcpp::QoS(100));
        }
        status_ = create_publisher<diagnostic_msgs::msg::DiagnosticArray>("/diagnostics", 10);
        tf_static_ = create_publisher<tf2_msgs::msg::TFMessage>("/tf_static",
                                                                rclcpp::QoS(1).transient_local());
        publish_mount();
    }

    void add_subscriptions(bool needs_camera) {
        image_ = create_subscription<Image>("image", rclcpp::SensorDataQoS(),
                                            [this](Image::ConstSharedPtr image) { take(*image); });
        if (!needs_camera) return;
        camera_info_ = create_subscription<CameraInfo>(
            "camera_info", rclcpp::SensorDataQoS(),
            [this](CameraInfo::ConstSharedPtr info) { take(*info); });
    }

    /// Takes the lens from the first camera_info; a camera file knows more.
    void take(const CameraInfo& info) {
        camera_info_.reset();
        if (info.k[0] == 0) {
            RCLCPP_WARN(get_logger(), "camera_info says that the camera was never calibrated");
            return;
        }
        try {
            options_.camera = camera_of(info);
            follower_.emplace(options_);
        } catch (const dotpose::Error& error) {
            options_.camera.reset();
            RCLCPP_WARN(get_logger(), "camera_info is not used: %s", error.what());
        }
    }

    void take(const Image& image) {
        if (image.encoding != "mono8" && image.encoding != "8UC1") {
            RCLCPP_WARN_ONCE(get_logger(), "images must be mono8, not %s", image.encoding.c_str());
            return;
        }
        if (image.data.size() < std::size_t{image.step} * image.height) return;
        const rclcpp::Time end = image.header.stamp;
        const std::int64_t time_ns = end.nanoseconds() - half_exposure_ns_;
        try {
            const dotpose::ImageView view = {image.data.data(), static_cast<int>(image.width),
                                             static_cast<int>(image.height),
                                             static_cast<std::ptrdiff_t>(image.step)};
            publish(follower_->follow(view, time_ns / 1000), time_ns);
        } catch (const dotpose::Error& error) {
            RCLCPP_ERROR_THROTTLE(get_logger(), *get_clock(), 5000, "%s", error.what());
        }
    }

    void publish(const dotpose::Followed& now, std::int64_t time_ns) {
        const dotpose::ros::RobotMessages messages =
            messenger_.messages(dotpose::ros::update_of(now, follower_->is_in_world(), time_ns));
        if (messages.pose) pose_->publish(to_ros(*messages.pose));
        if (messages.odometry) odometry_->publish(to_ros(*messages.odometry));
        if (messages.tf && tf_) tf_->publish(to_ros(*messages.tf));
        // Diagnostics are for people: at a change, and once a second.
        constexpr std::int64_t kPause_ns = 1'000'000'000;
        const std::string& state = messages.status.status.front().message;
        if (state == told_state_ && time_ns < told_ns_ + kPause_ns) return;
        told_state_ = state;
        told_ns_ = time_ns;
        status_->publish(to_ros(messages.status));
    }

    void publish_mount() {
        if (!options_.camera) return;
        auto mount = dotpose::ros::camera_mount(*options_.camera, messenger_.frames());
        if (!mount) return;
        mount->header.stamp = dotpose::ros::ros_time(now().nanoseconds());
        tf_static_->publish(to_ros(dotpose::ros::TFMessage{{*mount}}));
    }

    dotpose::FollowerOptions options_;
    std::optional<dotpose::Follower> follower_;
    dotpose::ros::RobotMessenger messenger_;
    std::int64_t half_exposure_ns_ = 0;
    std::string told_state_;
    std::int64_t told_ns_ = 0;
    rclcpp::Publisher<geometry_msgs::msg::PoseWithCovarianceStamped>::SharedPtr pose_;
    rclcpp::Publisher<nav_msgs::msg::Odometry>::SharedPtr odometry_;
    rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr tf_;
    rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr tf_static_;
    rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr status_;
    rclcpp::Subscription<Image>::SharedPtr image_;
    rclcpp::Subscription<CameraInfo>::SharedPtr camera_info_;
};

}  // namespace dotpose_ros

RCLCPP_COMPONENTS_REGISTER_NODE(dotpose_ros::LocatorNode)
