/// Robot locator: from the images of a camera to the messages of a robot. All that the node does
/// between its subscriptions and its publishers.
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

/// Returns the nanoseconds of a stamp, which may be before the start of its clock: rclcpp::Time
/// throws there.
std::int64_t nanoseconds(std::int32_t sec, std::uint32_t nanosec);

/// The members of a sensor_msgs/CameraInfo that describe the lens.
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
        /// The status is empty unless it is to be published: when it changes, and once a second.
        dotpose::ros::RobotMessages messages;
        /// For the log: what is wrong with the images. Empty unless that is new.
        std::string warning;
    };

    RobotLocator(const Settings& settings, std::string robot);

    /// Takes the next image, which has a stamp of its camera and came at `arrival_ns` by a clock
    /// that is never set. An image that is not newer than those before is left out. If the stamps
    /// after it increase from there, time was set back (a bag that begins again, a simulation), and
    /// tracking starts again.
    Answer take(const RawImage& image, std::int64_t stamp_ns, std::int64_t arrival_ns);

    /// Takes the lens of the camera, unless a camera file or an earlier call gave it. Returns, for
    /// the log, why it cannot be used; empty if it can, or if that was returned before.
    std::string take(const Lens& lens);

    /// Returns where the camera sits, or none if there is no camera file that says it.
    std::optional<dotpose::ros::TransformStamped> mount(std::int64_t time_ns) const;

  private:
    enum class Order { next, left_out, set_back };

    Order order_of(std::int64_t time_us);
    dotpose::ros::RobotMessages locate(const RawImage& image, std::int64_t time_ns);
    dotpose::ros::RobotMessages without_image(std::int64_t time_ns, const std::string& problem);
    bool is_status_due(const std::string& status, std::int64_t arrival_ns);
    void require_size_of_lens(const RawImage& image) const;
    void begin_anew() { follower_.emplace(options_); }

    dotpose::FollowerOptions options_;
    std::int64_t half_exposure_ns_;
    bool has_lens_;
    std::optional<Lens> refused_lens_;
    std::string lens_problem_;  ///< part of each status
    std::optional<dotpose::Follower> follower_;
    dotpose::ros::RobotMessenger messenger_;
    dotpose::GreyImage grey_;
    // Times of images: the newest that was taken, and the last that came.
    std::int64_t newest_us_ = std::numeric_limits<std::int64_t>::min();
    std::int64_t last_us_ = std::numeric_limits<std::int64_t>::max();
    int left_out_ = 0;  ///< number of images left out since the newest
    std::string told_status_;
    std::int64_t told_ns_ = 0;
    std::string told_problem_;
};

}  // namespace dotpose_ros
