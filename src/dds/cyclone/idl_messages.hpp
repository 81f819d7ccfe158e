// Converts messages to the structs that idlc generates and DDS serialises.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <ros_messages.h>

#include "dotpose/tools/ros_messages.hpp"

namespace dotpose::dds {

// The structs returned by `idl` contain pointers into the messages and must not outlive them. DDS
// does not modify the messages.

inline char* idl(const std::string& text) {
    return const_cast<char*>(text.c_str());
}

inline std_msgs_msg_dds__Header_ idl(const ros::Header& header) {
    return {{header.stamp.sec, header.stamp.nanosec}, idl(header.frame_id)};
}

inline geometry_msgs_msg_dds__Vector3_ idl(const ros::Vector3& vector) {
    return {vector.x, vector.y, vector.z};
}

inline geometry_msgs_msg_dds__Quaternion_ idl(const ros::Quaternion& rotation) {
    return {rotation.x, rotation.y, rotation.z, rotation.w};
}

inline geometry_msgs_msg_dds__PoseWithCovariance_ idl(const ros::PoseWithCovariance& pose) {
    const ros::Vector3& position = pose.pose.position;
    geometry_msgs_msg_dds__PoseWithCovariance_ result{
        {{position.x, position.y, position.z}, idl(pose.pose.orientation)}, {}};
    std::ranges::copy(pose.covariance, result.covariance);
    return result;
}

inline geometry_msgs_msg_dds__TwistWithCovariance_ idl(const ros::TwistWithCovariance& twist) {
    geometry_msgs_msg_dds__TwistWithCovariance_ result{
        {idl(twist.twist.linear), idl(twist.twist.angular)}, {}};
    std::ranges::copy(twist.covariance, result.covariance);
    return result;
}

inline geometry_msgs_msg_dds__TransformStamped_ idl(const ros::TransformStamped& transform) {
    return {idl(transform.header),
            idl(transform.child_frame_id),
            {idl(transform.transform.translation), idl(transform.transform.rotation)}};
}

inline diagnostic_msgs_msg_dds__KeyValue_ idl(const ros::KeyValue& pair) {
    return {idl(pair.key), idl(pair.value)};
}

/// Returns a DDS sequence that points to the elements of `buffer`.
template <typename Sequence, typename Element>
Sequence sequence_in(std::vector<Element>& buffer) {
    const auto size = static_cast<std::uint32_t>(buffer.size());
    return {size, size, buffer.data(), false};
}

}  // namespace dotpose::dds
