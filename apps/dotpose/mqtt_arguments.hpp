/// Command-line options for the MQTT broker, shared by `watch`, `listen` and `fleet`.
#pragma once

#include <string>

#include "command_line.hpp"

namespace dotpose::cli {

struct MqttArguments {
    std::string url;  ///< empty: no broker
    std::string ca_file;
    int qos = 0;

    /// Adds --mqtt, --mqtt-ca and --qos.
    void add_to(Command& command);
};

/// Options of commands that publish the states of a robot.
struct PublishArguments {
    MqttArguments mqtt;
    std::string robot = "robot";  ///< name of the robot on the broker and in ROS
    /// Maximum number of messages per second. Messages about events are sent in addition. If 0, a
    /// message is sent for each frame.
    double max_rate_hz = 0;

    /// Adds the options of MqttArguments, --robot and --mqtt-rate. `robot_help` describes --robot.
    void add_to(Command& command, const std::string& robot_help);
};

}  // namespace dotpose::cli
