#include "robot_output.hpp"

#include <chrono>
#include <utility>

#include <fmt/core.h>

#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

ros::RobotUpdate update_of(const Reading& reading, std::int64_t stamp_ns) {
    Followed followed;
    followed.located.fix = reading.record.fix;
    followed.located.place = reading.record.place;
    followed.located.spacing_mm = reading.record.spacing_mm;
    followed.located.space = reading.record.space;
    followed.track = reading.track;
    followed.space_track = reading.space_track;
    return ros::update_of(followed, reading.plane == Plane::sheet_world, stamp_ns);
}

}  // namespace

std::int64_t Stamps::of(const capture::Frame& frame) {
    constexpr std::int64_t kNs_per_us = 1000;
    const std::int64_t time_ns = frame.time_us * kNs_per_us;
    if (!frame.is_live) return time_ns;
    if (!system_from_monotonic_ns_) {
        using namespace std::chrono;
        system_from_monotonic_ns_ = nanoseconds(system_clock::now().time_since_epoch()).count() -
                                    nanoseconds(steady_clock::now().time_since_epoch()).count();
    }
    return time_ns + *system_from_monotonic_ns_ - half_exposure_ns_;
}

RobotOutput::RobotOutput(const RobotOutputOptions& options)
    : options_(options),
      stamps_(options.camera ? options.camera->exposure_us.value_or(0) : 0),
      messenger_(options.robot, ros::with_prefix(options.frame_prefix)),
      sends_mount_(!options.has_space_pose) {
    if (!options.mcap.empty()) recording_.emplace(options.mcap, options.robot);
    if (!options.dds) return;
    dds::PublisherOptions publisher = *options.dds;
    publisher.has_space_pose = options.has_space_pose;
    publisher_.emplace(ros_name(options.robot), publisher);
}

void RobotOutput::take(const capture::Frame& frame, const Reading& reading) {
    const std::int64_t stamp_ns = stamps_.of(frame);
    if (std::exchange(sends_mount_, false) && options_.camera) {
        if (auto mount = ros::camera_mount(*options_.camera, messenger_.frames())) {
            mount->header.stamp = ros::ros_time(stamp_ns);
            if (recording_) recording_->take_mount(*mount, stamp_ns);
            if (publisher_) publisher_->publish(*mount);
        }
    }
    const ros::RobotMessages messages = messenger_.messages(update_of(reading, stamp_ns));
    if (publisher_) publisher_->publish(messages, !frame.is_live);
    if (!recording_) return;
    recording_->take(messages, stamp_ns);
    if (!options_.has_images || frame.image.pixels.empty()) return;
    recording_->take_image({{ros::ros_time(stamp_ns), messenger_.frames().camera},
                            options_.image_format == ImageEncoding::jpeg ? "jpeg" : "png",
                            encode_image(options_.image_format, frame.image.view())},
                           stamp_ns);
}

void RobotOutput::set_camera(const Camera& camera) {
    options_.camera = camera;
    sends_mount_ = !options_.has_space_pose;
}

void RobotOutput::finish() {
    if (recording_) recording_->finish();
    if (!publisher_) return;
    notify(fmt::format("{} messages published over DDS, {} dropped", publisher_->sent(),
                       publisher_->dropped()));
}

}  // namespace dotpose::cli
