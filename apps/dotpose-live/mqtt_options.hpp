/// Converts command-line options to MQTT connection options.
#pragma once

#include <optional>

#include "mqtt_arguments.hpp"
#include "publish/mqtt.hpp"

namespace dotpose::cli {

/// Returns the options, or nullopt if --mqtt is not given. The password may be in the environment
/// variable DOTPOSE_MQTT_PASSWORD. Throws BadArgument if the URL is invalid.
std::optional<publish::MqttOptions> mqtt_options(const MqttArguments& arguments);

}  // namespace dotpose::cli
