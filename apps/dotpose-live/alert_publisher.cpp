#include "alert_publisher.hpp"

#include <chrono>
#include <utility>

#include <fmt/core.h>

#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

publish::MqttOptions with_queue(publish::MqttOptions options) {
    // The queue has room for one alert per robot, because the conditions of all robots may change
    // at the same time, for example when the network fails.
    options.queue = FleetState::kMaxRobots;
    options.qos = 1;
    return options;
}

}  // namespace

AlertPublisher::AlertPublisher(publish::MqttOptions options)
    : publisher_(with_queue(std::move(options))) {}

void AlertPublisher::check(const FleetRobots& robots, const Now& now) {
    for (RobotAlert& alert : watch_.changes(robots, now)) {
        alert.header_id = messages_++;
        alert.sent_us = now.system_us;
        publisher_.publish(fmt::format("{}/{}", kAlertRoot, alert.robot), json_of(alert));
    }
}

void AlertPublisher::finish() {
    constexpr auto kPatience = std::chrono::seconds(2);
    publisher_.flush(kPatience);
    notify(fmt::format("{} alerts published, {} dropped", publisher_.sent(),
                       publisher_.dropped() + publisher_.unsent()));
}

}  // namespace dotpose::cli
