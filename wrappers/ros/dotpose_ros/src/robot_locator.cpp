#include "robot_locator.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include <dotpose/files/camera_file.hpp>
#include <dotpose/files/error.hpp>

namespace dotpose_ros {
namespace {

namespace ros = dotpose::ros;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Number of consecutive skipped images after which an error is reported. Images are skipped if
/// their stamps do not increase.
constexpr int kStandstill = 3;

/// Formats a lens as the text of a camera_info file, because the parser for such files checks all
/// values.
std::string camera_info_text(const Lens& lens) {
    std::ostringstream text;
    text.precision(17);
    const auto write = [&text](const char* key, const auto& values) {
        text << key << ": [";
        for (std::size_t i = 0; i < values.size(); ++i)
            text << (i > 0 ? ", " : "") << values[i];
        text << "]\n";
    };
    text << "width: " << lens.width << "\nheight: " << lens.height << "\ndistortion_model: '"
         << lens.distortion_model << "'\n";
    write("k", lens.k);
    write("d", lens.d);
    return text.str();
}

}  // namespace

std::int64_t nanoseconds(std::int32_t sec, std::uint32_t nanosec) {
    return sec * kSecond_ns + nanosec;
}

RobotLocator::RobotLocator(const Settings& settings, std::string robot)
    : options_(settings.follower),
      half_exposure_ns_(settings.half_exposure_ns),
      has_lens_(settings.follower.camera.has_value()),
      messenger_(std::move(robot), settings.frames) {
    if (!has_lens_) lens_problem_ = missing_lens();
    restart();
}

/// Describes the problem caused by a missing lens. Returns an empty string if the lens is not
/// needed.
std::string RobotLocator::missing_lens() const {
    return options_.fits_space_pose ? "there are no poses in space until camera_info has a lens"
                                    : "";
}

/// Restarts tracking. Poses in space are fitted only if the lens is known.
void RobotLocator::restart() {
    dotpose::FollowerOptions options = options_;
    options.fits_space_pose = options_.fits_space_pose && has_lens_;
    follower_.emplace(options);
}

RobotLocator::Answer RobotLocator::take(const RawImage& image, std::int64_t stamp_ns,
                                        std::int64_t arrival_ns) {
    const std::int64_t time_ns = stamp_ns - half_exposure_ns_;
    Answer answer;
    std::string problem;
    const Order order = order_of(time_ns / 1000);
    left_out_ = order == Order::left_out ? left_out_ + 1 : 0;
    if (order == Order::left_out) {
        if (left_out_ < kStandstill) return answer;
        problem =
            "images are skipped because their stamps do not increase; correct the clock of the "
            "camera driver";
    } else {
        if (order == Order::set_back) {
            restart();
            answer.warning = "the stamps of images went back; tracking restarts";
        }
        try {
            answer.messages = locate(image, time_ns);
        } catch (const dotpose::Error& error) {
            problem = error.what();
        }
    }
    if (!problem.empty()) answer.messages = without_image(time_ns, problem);
    if (problem != std::exchange(told_problem_, problem) && !problem.empty())
        answer.warning = problem;
    if (!is_status_due(answer.messages.status.status.front().message, arrival_ns))
        answer.messages.status.status.clear();
    return answer;
}

/// Returns true if the status has changed or was last published at least a second ago. If so,
/// records the status as published.
bool RobotLocator::is_status_due(const std::string& status, std::int64_t arrival_ns) {
    if (status == told_status_ && arrival_ns < told_ns_ + kSecond_ns) return false;
    told_status_ = status;
    told_ns_ = arrival_ns;
    return true;
}

/// Compares the time of an image with the times of the newest processed and the last received
/// image, and updates these times.
RobotLocator::Order RobotLocator::order_of(std::int64_t time_us) {
    const bool is_newer_than_last = time_us > std::exchange(last_us_, time_us);
    if (time_us <= newest_us_ && !is_newer_than_last) return Order::left_out;
    return time_us > std::exchange(newest_us_, time_us) ? Order::next : Order::set_back;
}

ros::RobotMessages RobotLocator::locate(const RawImage& image, std::int64_t time_ns) {
    const dotpose::ImageView view = grey_view(image, grey_);
    require_size_of_lens(image);
    const dotpose::Followed now = follower_->follow(view, time_ns / 1000);
    ros::RobotMessages messages =
        messenger_.messages(ros::update_of(now, follower_->is_in_world(), time_ns));
    if (lens_problem_.empty()) return messages;
    ros::DiagnosticStatus& status = messages.status.status.front();
    constexpr std::uint8_t kWarning = 1;
    status.level = std::max(status.level, kWarning);
    status.message += "; " + lens_problem_;
    return messages;
}

/// Returns the status message for an image that cannot be used because of `problem`.
ros::RobotMessages RobotLocator::without_image(std::int64_t time_ns, const std::string& problem) {
    ros::RobotUpdate update;
    update.time_ns = time_ns;
    update.state = "no image";
    update.problem = problem;
    return messenger_.messages(update);
}

void RobotLocator::require_size_of_lens(const RawImage& image) const {
    const auto& camera = options_.camera;
    if (!camera || (static_cast<int>(image.width) == camera->width_px &&
                    static_cast<int>(image.height) == camera->height_px)) {
        return;
    }
    std::ostringstream problem;
    problem << "images have " << image.width << " x " << image.height
            << " px, but the camera file or camera_info is for " << camera->width_px << " x "
            << camera->height_px << ": set the camera to that size, or calibrate it at this one";
    throw dotpose::Error(problem.str());
}

std::string RobotLocator::take(const Lens& lens) {
    if (has_lens_ || lens == refused_lens_) return {};
    refused_lens_ = lens;
    const std::string before = std::exchange(lens_problem_, missing_lens());
    if (lens.k[0] == 0) {
        return "camera_info says that the camera was never calibrated: images are located without "
               "a "
               "lens; 'dotpose calibrate' writes a camera file";
    }
    try {
        options_.camera = dotpose::parse_camera(camera_info_text(lens), "camera_info");
        has_lens_ = true;
        lens_problem_.clear();
        restart();
    } catch (const dotpose::Error& error) {
        lens_problem_ = std::string("images are located without a lens: ") + error.what();
    }
    return lens_problem_ == before ? std::string() : lens_problem_;
}

std::optional<ros::TransformStamped> RobotLocator::mount(std::int64_t time_ns) const {
    if (!options_.camera || has_space_pose()) return std::nullopt;
    auto mount = ros::camera_mount(*options_.camera, messenger_.frames());
    if (mount) mount->header.stamp = ros::ros_time(time_ns);
    return mount;
}

}  // namespace dotpose_ros
