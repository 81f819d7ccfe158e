/// Connection to the MQTT broker that the command line specifies.
#pragma once

#include <optional>

#include "mqtt_arguments.hpp"
#include "publish/mqtt.hpp"

namespace dotpose::cli {

/// Returns the options, or none without --mqtt. The environment variable DOTPOSE_MQTT_PASSWORD may
/// contain the password. Throws BadArgument if the URL is not valid.
std::optional<publish::MqttOptions> mqtt_options(const MqttArguments& arguments);

}  // namespace dotpose::cli
