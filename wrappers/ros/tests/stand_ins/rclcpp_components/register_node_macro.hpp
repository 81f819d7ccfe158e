/// Stands in for rclcpp_components, as rclcpp.hpp beside it.
#pragma once

#include <rclcpp/rclcpp.hpp>

/// A component can be made of options.
#define RCLCPP_COMPONENTS_REGISTER_NODE(type) \
    static_assert(std::is_constructible_v<type, const rclcpp::NodeOptions&>);
