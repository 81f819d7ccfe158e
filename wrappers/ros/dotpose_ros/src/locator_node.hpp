/// Creates the node in programs. Component containers load it as dotpose_ros::LocatorNode.
#pragma once

#include <memory>

#include <rclcpp/rclcpp.hpp>

namespace dotpose_ros {

/// Throws std::exception if a parameter, or a file named by a parameter, cannot be used.
std::shared_ptr<rclcpp::Node> make_locator_node(const rclcpp::NodeOptions& options);

}  // namespace dotpose_ros
