/// The node as programs make it; component containers load it as dotpose_ros::LocatorNode.
#pragma once

#include <memory>

#include <rclcpp/rclcpp.hpp>

namespace dotpose_ros {

/// Throws std::exception if a parameter or a file that it names cannot be used.
std::shared_ptr<rclcpp::Node> make_locator_node(const rclcpp::NodeOptions& options);

}  // namespace dotpose_ros
