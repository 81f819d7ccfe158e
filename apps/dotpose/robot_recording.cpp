#include "robot_recording.hpp"

#include <algorithm>
#include <cctype>

#include "system/path.hpp"

namespace dotpose::cli {

std::string ros_name(const std::string& robot) {
    std::string name = robot;
    std::ranges::replace_if(
        name, [](unsigned char c) { return c > 127 || std::isalnum(c) == 0; }, '_');
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
        name.insert(name.begin(), '_');
    }
    return name;
}

RobotTopics::RobotTopics(const std::string& robot)
    : pose('/' + ros_name(robot) + "/pose"),
      camera('/' + ros_name(robot) + "/camera_pose"),
      odometry('/' + ros_name(robot) + "/odom"),
      camera_odometry('/' + ros_name(robot) + "/camera_odom"),
      status('/' + ros_name(robot) + "/status"),
      image('/' + ros_name(robot) + "/image/compressed") {}

RobotRecording::RobotRecording(const std::string& path, const std::string& robot)
    : file_(system::path_of(path)), topics_(robot) {}

template <typename Message>
void RobotRecording::write(std::optional<McapChannel>& channel, const std::string& topic,
                           const Message& message, std::int64_t time_ns) {
    if (!channel) channel = file_.add_channel(topic, ros::type_of(message));
    file_.write(*channel, time_ns, ros::to_cdr(message));
}

void RobotRecording::take(const ros::RobotMessages& messages, std::int64_t time_ns) {
    if (messages.pose) write(poses_, topics_.pose, *messages.pose, time_ns);
    if (messages.camera) write(cameras_, topics_.camera, *messages.camera, time_ns);
    if (messages.odometry) write(odometry_, topics_.odometry, *messages.odometry, time_ns);
    if (messages.camera_odometry)
        write(camera_odometry_, topics_.camera_odometry, *messages.camera_odometry, time_ns);
    if (messages.tf) write(tf_, RobotTopics::kTf, *messages.tf, time_ns);
    write(status_, topics_.status, messages.status, time_ns);
}

void RobotRecording::take_mount(const ros::TransformStamped& mount, std::int64_t time_ns) {
    if (!tf_static_) {
        tf_static_ = file_.add_channel(RobotTopics::kTfStatic, ros::type_of(ros::TFMessage{}),
                                       {.depth = 1, .is_transient_local = true});
    }
    write(tf_static_, RobotTopics::kTfStatic, ros::TFMessage{{mount}}, time_ns);
}

void RobotRecording::take_image(const ros::CompressedImage& image, std::int64_t time_ns) {
    write(images_, topics_.image, image, time_ns);
}

}  // namespace dotpose::cli
