#include "mqtt_arguments.hpp"

#include <cstdio>
#include <cstdlib>

#include <fmt/core.h>

#include "terminal_text.hpp"

namespace dotpose::cli {

Option* MqttArguments::add_to(Command& command) {
    command.add_option("--mqtt-ca", ca_file_, "Certificates to trust (mqtts)")->type_name("FILE");
    command.add_option("--qos", qos_, "0: states may be lost; 1: states arrive, possibly twice")
        ->type_name("N")
        ->capture_default_str()
        ->check(Range(0, 1));
    return command
        .add_option("--mqtt", url_,
                    "Broker: mqtt://[USER[:PASSWORD]@]HOST[:PORT], or mqtts:// for TLS; the "
                    "password may be in DOTPOSE_MQTT_PASSWORD")
        ->type_name("URL");
}

std::optional<publish::MqttOptions> MqttArguments::options() const {
    if (url_.empty()) return std::nullopt;
    publish::MqttOptions options;
    publish::parse_url(url_, options);
    const char* password = std::getenv("DOTPOSE_MQTT_PASSWORD");
    if (options.password.empty() && password != nullptr) options.password = password;
    options.ca_file = ca_file_;
    options.qos = qos_;
    options.tell = tell;
    return options;
}

}  // namespace dotpose::cli
