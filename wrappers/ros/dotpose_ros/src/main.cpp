// Runs the node as a program. If the node cannot be started, prints the error and returns a nonzero
// exit status.
#include <cstdio>
#include <exception>

#include <rclcpp/rclcpp.hpp>

#include "locator_node.hpp"

int main(int argc, char** argv) {
    try {
        rclcpp::init(argc, argv);
        rclcpp::spin(dotpose_ros::make_locator_node(rclcpp::NodeOptions()));
        rclcpp::shutdown();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "dotpose_ros: %s\n", error.what());
        return 1;
    }
}
