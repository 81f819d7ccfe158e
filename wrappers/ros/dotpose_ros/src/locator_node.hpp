/// Creates the node in a program. Component containers instead load it as the component
/// dotpose_ros::LocatorNode.
#pragma once

#include <memory>

#include <rclcpp/rclcpp.hpp>

namespace dotpose_ros {

/// Throws std::exception if a parameter, or a file that a parameter names, cannot be used.
std::shared_ptr<rclcpp::Node> make_locator_node(const rclcpp::NodeOptions& options);

}  // namespace dotpose_ros
