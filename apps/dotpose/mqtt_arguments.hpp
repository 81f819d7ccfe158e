/// Command-line options for the MQTT broker, used by the commands `watch`, `listen` and `fleet`.
#pragma once

#include <string>

#include "command_line.hpp"

namespace dotpose::cli {

struct MqttArguments {
    std::string url;  ///< URL of the broker, or empty for none
    std::string ca_file;
    int qos = 0;

    /// Adds --mqtt, --mqtt-ca and --qos.
    void add_to(Command& command);
};

/// Options for commands that publish the state of a robot.
struct PublishArguments {
    MqttArguments mqtt;
    std::string robot = "robot";  ///< name of the robot in MQTT topics and in ROS
    /// Maximum number of messages per second, or 0 to send a message for every frame. Messages
    /// about events are not counted.
    double max_rate_hz = 0;

    /// Adds the options of MqttArguments, --robot and --mqtt-rate. `robot_help` describes --robot.
    void add_to(Command& command, const std::string& robot_help);
};

}  // namespace dotpose::cli
