// Converts the messages of dotpose, which do not depend on ROS, to the ROS messages with the same
// members.
#pragma once

#include <algorithm>

#include <diagnostic_msgs/msg/diagnostic_array.hpp>
#include <geometry_msgs/msg/pose_with_covariance_stamped.hpp>
#include <nav_msgs/msg/odometry.hpp>
#include <tf2_msgs/msg/tf_message.hpp>

#include <dotpose/tools/ros_messages.hpp>

namespace dotpose_ros {

inline std_msgs::msg::Header to_ros(const dotpose::ros::Header& header) {
    std_msgs::msg::Header result;
    result.stamp.sec = header.stamp.sec;
    result.stamp.nanosec = header.stamp.nanosec;
    result.frame_id = header.frame_id;
    return result;
}

template <typename Xyz>
void copy_xyz(const dotpose::ros::Vector3& from, Xyz& to) {
    to.x = from.x;
    to.y = from.y;
    to.z = from.z;
}

inline geometry_msgs::msg::Quaternion to_ros(const dotpose::ros::Quaternion& rotation) {
    geometry_msgs::msg::Quaternion result;
    result.x = rotation.x;
    result.y = rotation.y;
    result.z = rotation.z;
    result.w = rotation.w;
    return result;
}

inline geometry_msgs::msg::PoseWithCovariance to_ros(const dotpose::ros::PoseWithCovariance& pose) {
    geometry_msgs::msg::PoseWithCovariance result;
    copy_xyz(pose.pose.position, result.pose.position);
    result.pose.orientation = to_ros(pose.pose.orientation);
    std::ranges::copy(pose.covariance, result.covariance.begin());
    return result;
}

inline geometry_msgs::msg::PoseWithCovarianceStamped to_ros(
    const dotpose::ros::PoseWithCovarianceStamped& message) {
    geometry_msgs::msg::PoseWithCovarianceStamped result;
    result.header = to_ros(message.header);
    result.pose = to_ros(message.pose);
    return result;
}

inline nav_msgs::msg::Odometry to_ros(const dotpose::ros::Odometry& message) {
    nav_msgs::msg::Odometry result;
    result.header = to_ros(message.header);
    result.child_frame_id = message.child_frame_id;
    result.pose = to_ros(message.pose);
    copy_xyz(message.twist.twist.linear, result.twist.twist.linear);
    copy_xyz(message.twist.twist.angular, result.twist.twist.angular);
    std::ranges::copy(message.twist.covariance, result.twist.covariance.begin());
    return result;
}

inline tf2_msgs::msg::TFMessage to_ros(const dotpose::ros::TFMessage& message) {
    tf2_msgs::msg::TFMessage result;
    for (const dotpose::ros::TransformStamped& each : message.transforms) {
        geometry_msgs::msg::TransformStamped transform;
        transform.header = to_ros(each.header);
        transform.child_frame_id = each.child_frame_id;
        copy_xyz(each.transform.translation, transform.transform.translation);
        transform.transform.rotation = to_ros(each.transform.rotation);
        result.transforms.push_back(transform);
    }
    return result;
}

inline diagnostic_msgs::msg::DiagnosticArray to_ros(const dotpose::ros::DiagnosticArray& message) {
    diagnostic_msgs::msg::DiagnosticArray result;
    result.header = to_ros(message.header);
    for (const dotpose::ros::DiagnosticStatus& each : message.status) {
        diagnostic_msgs::msg::DiagnosticStatus status;
        status.level = each.level;
        status.name = each.name;
        status.message = each.message;
        status.hardware_id = each.hardware_id;
        for (const dotpose::ros::KeyValue& pair : each.values) {
            diagnostic_msgs::msg::KeyValue value;
            value.key = pair.key;
            value.value = pair.value;
            status.values.push_back(value);
        }
        result.status.push_back(status);
    }
    return result;
}

}  // namespace dotpose_ros
