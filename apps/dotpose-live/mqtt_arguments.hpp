/// The options of a broker, shared by `watch` and `fleet`.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "publish/mqtt.hpp"

namespace dotpose::cli {

class MqttArguments {
  public:
    /// --mqtt, --mqtt-ca and --qos.
    CLI::Option* add_to(CLI::App& command);

    /// None if no broker was named. The password may stand in the environment variable
    /// DOTPOSE_MQTT_PASSWORD. Throws BadArgument.
    std::optional<publish::MqttOptions> options() const;

    const std::string& ca_file() const { return ca_file_; }

  private:
    std::string url_;
    std::string ca_file_;
    int qos_ = 0;
};

}  // namespace dotpose::cli
