// The node as a program. Errors at the start are printed and give a non-zero exit status.
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
