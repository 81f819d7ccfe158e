/// The options of a broker, which `watch` and `fleet` share.
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

    /// Returns none if no broker was given. The password may be in the environment variable
    /// DOTPOSE_MQTT_PASSWORD. Throws BadArgument if the options are invalid.
    std::optional<publish::MqttOptions> options() const;

    const std::string& ca_file() const { return ca_file_; }

  private:
    std::string url_;
    std::string ca_file_;
    int qos_ = 0;
};

}  // namespace dotpose::cli
