#include "robot_remover.hpp"

#include <chrono>
#include <utility>

#include "fleet_state.hpp"

namespace dotpose::cli {
namespace {

publish::MqttOptions for_removals(publish::MqttOptions options) {
    options.queue = FleetState::kMaxRobots;
    options.qos = 1;
    return options;
}

}  // namespace

RobotRemover::RobotRemover(publish::MqttOptions options)
    : publisher_(for_removals(std::move(options))) {}

RobotRemover::~RobotRemover() {
    constexpr auto kPatience = std::chrono::seconds(2);
    publisher_.flush(kPatience);
}

void RobotRemover::remove(const std::string& robot) {
    publisher_.publish(topic_of(robot, Subject::connection), {}, true);
}

}  // namespace dotpose::cli
