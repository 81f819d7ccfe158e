/// Command-line options for the MQTT broker, shared by `watch` and `fleet`.
#pragma once

#include <optional>
#include <string>

#include "command_line.hpp"
#include "publish/mqtt.hpp"

namespace dotpose::cli {

class MqttArguments {
  public:
    /// Adds --mqtt, --mqtt-ca and --qos.
    Option* add_to(Command& command);

    /// Returns the options, or none without --mqtt. The environment variable DOTPOSE_MQTT_PASSWORD
    /// may contain the password. Throws BadArgument if the options are invalid.
    std::optional<publish::MqttOptions> options() const;

    const std::string& ca_file() const { return ca_file_; }

  private:
    std::string url_;
    std::string ca_file_;
    int qos_ = 0;
};

}  // namespace dotpose::cli
