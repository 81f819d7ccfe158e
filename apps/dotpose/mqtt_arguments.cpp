#include "mqtt_arguments.hpp"

#include "robot_name.hpp"

namespace dotpose::cli {

void MqttArguments::add_to(Command& command) {
    command.add_option("--mqtt-ca", ca_file, "Certificates to trust (mqtts)")->type_name("FILE");
    command.add_option("--qos", qos, "0: states may be lost; 1: states arrive, possibly twice")
        ->type_name("N")
        ->capture_default_str()
        ->check(Range(0, 1));
    command
        .add_option("--mqtt", url,
                    "Broker: mqtt://[USER[:PASSWORD]@]HOST[:PORT], or mqtts:// for TLS; the "
                    "password may be in DOTPOSE_MQTT_PASSWORD")
        ->type_name("URL");
}

void PublishArguments::add_to(Command& command, const std::string& robot_help) {
    mqtt.add_to(command);
    add_robot_option(command, robot, robot_help);
    command
        .add_option("--mqtt-rate", max_rate_hz,
                    "Maximum number of states per second; events are always sent")
        ->type_name("HZ")
        ->default_str("all")
        ->check(Range(0.001, 1e6));
}

}  // namespace dotpose::cli
