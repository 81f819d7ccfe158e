/// RobotLocator computes the messages of a robot from the images of its camera. It implements
/// everything that happens between the subscriptions and the publishers of the node.
///
///     RobotLocator locator(settings_of(values), "anna");
///     const RobotLocator::Answer answer = locator.take(image, stamp_ns, arrival_ns);
///     if (answer.messages.pose) publish(*answer.messages.pose);
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <dotpose/tools/follower.hpp>
#include <dotpose/tools/robot_messages.hpp>

#include "parameters.hpp"
#include "raw_image.hpp"

namespace dotpose_ros {

/// Converts a stamp to nanoseconds. Accepts negative stamps, for which rclcpp::Time throws an
/// exception.
std::int64_t nanoseconds(std::int32_t sec, std::uint32_t nanosec);

/// Members of a sensor_msgs/CameraInfo that describe the lens.
struct Lens {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::string distortion_model;
    std::array<double, 9> k{};
    std::vector<double> d;

    bool operator==(const Lens&) const = default;
};

class RobotLocator {
  public:
    struct Answer {
        /// Messages to publish. The status is included only if it has changed, or if no status has
        /// been published for at least a second.
        dotpose::ros::RobotMessages messages;
        /// New warning about the images, to be logged. Empty if there is none.
        std::string warning;
    };

    RobotLocator(const Settings& settings, std::string robot);

    /// Processes the next image. `stamp_ns` is the stamp of the camera, and `arrival_ns` is the
    /// arrival time on a steady clock. An image that is not newer than the previous images is
    /// skipped. If the next stamp is later than the stamp of the skipped image, the clock must have
    /// been set back, for example because a bag or a simulation was restarted. In this case,
    /// tracking restarts.
    Answer take(const RawImage& image, std::int64_t stamp_ns, std::int64_t arrival_ns);

    /// Uses the lens of a camera_info message, unless the lens is already known from a camera file
    /// or an earlier message. If the lens cannot be used, returns the reason, which should be
    /// logged. Returns an empty string if the lens is used, or if the reason was already reported.
    std::string take(const Lens& lens);

    /// Returns true if poses in space are fitted once the lens is known.
    bool has_space_pose() const { return options_.fits_space_pose; }

    /// Returns the mount of the camera. Returns nullopt if the camera file does not contain a
    /// mount, or if poses in space are fitted.
    std::optional<dotpose::ros::TransformStamped> mount(std::int64_t time_ns) const;

  private:
    enum class Order { next, left_out, set_back };

    Order order_of(std::int64_t time_us);
    dotpose::ros::RobotMessages locate(const RawImage& image, std::int64_t time_ns);
    dotpose::ros::RobotMessages without_image(std::int64_t time_ns, const std::string& problem);
    bool is_status_due(const std::string& status, std::int64_t arrival_ns);
    void require_size_of_lens(const RawImage& image) const;
    std::string missing_lens() const;
    void restart();

    dotpose::FollowerOptions options_;
    std::int64_t half_exposure_ns_;
    bool has_lens_;
    std::optional<Lens> refused_lens_;
    std::string lens_problem_;  ///< reason why the lens cannot be used; appended to each status
    std::optional<dotpose::Follower> follower_;
    dotpose::ros::RobotMessenger messenger_;
    dotpose::GreyImage grey_;
    // Times of the newest processed image, and of the last received image.
    std::int64_t newest_us_ = std::numeric_limits<std::int64_t>::min();
    std::int64_t last_us_ = std::numeric_limits<std::int64_t>::max();
    int left_out_ = 0;  ///< number of images skipped since the newest processed image
    std::string told_status_;
    std::int64_t told_ns_ = 0;
    std::string told_problem_;
};

}  // namespace dotpose_ros
