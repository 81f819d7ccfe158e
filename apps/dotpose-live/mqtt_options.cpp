#include "mqtt_options.hpp"

#include <cstdlib>

#include "terminal_text.hpp"

namespace dotpose::cli {

std::optional<publish::MqttOptions> mqtt_options(const MqttArguments& arguments) {
    if (arguments.url.empty()) return std::nullopt;
    publish::MqttOptions options;
    publish::parse_url(arguments.url, options);
    const char* password = std::getenv("DOTPOSE_MQTT_PASSWORD");
    if (options.password.empty() && password != nullptr) options.password = password;
    options.ca_file = arguments.ca_file;
    options.qos = arguments.qos;
    options.notify = notify;
    return options;
}

}  // namespace dotpose::cli
