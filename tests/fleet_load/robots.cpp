#include "robots.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/core.h>

#include "state_message.hpp"

namespace dotpose::test {
namespace {

constexpr int kPoints = 40;

/// Returns the state of a robot at a point on its circle. Robots pass 20 points per second.
cli::RobotState state_at(int robot, int point) {
    constexpr double kRadius_m = 0.2;
    constexpr double kBetween_m = 0.5;
    constexpr int kPerRow = 100;
    const double angle = 2 * std::numbers::pi * point / kPoints;
    const double speed_m_s = 2 * std::numbers::pi * kRadius_m * 20 / kPoints;
    cli::RobotState state;
    state.robot = fmt::format("robot{}", robot);
    state.state = "moving";
    state.map_id = "table";
    state.is_localized = true;
    state.x_m = robot % kPerRow * kBetween_m + kRadius_m * std::cos(angle);
    state.y_m = robot / kPerRow * kBetween_m + kRadius_m * std::sin(angle);
    state.theta_rad = std::remainder(angle + std::numbers::pi / 2, 2 * std::numbers::pi);
    state.deviation_m = 3.5e-7;
    state.vx_m_s = -speed_m_s * std::sin(angle);
    state.vy_m_s = speed_m_s * std::cos(angle);
    state.omega_rad_s = speed_m_s / kRadius_m;
    return state;
}

/// Returns the part of a message that follows its number and time.
std::string tail_of(const cli::RobotState& state) {
    const std::string text = cli::json_of(state);
    return text.substr(text.find(R"(","version")"));
}

}  // namespace

Robots::Robots(int first, int count) {
    for (int robot = first; robot < first + count; ++robot) {
        topics_.push_back(
            cli::topic_of(fmt::format("robot{}", robot), cli::Subject::visualization));
        auto& tails = tails_.emplace_back();
        for (int point = 0; point < kPoints; ++point)
            tails.push_back(tail_of(state_at(robot, point)));
    }
}

std::string Robots::state(int robot, std::int64_t number, const std::string& timestamp) const {
    const auto& tails = tails_[index(robot)];
    return fmt::format(R"({{"headerId":{},"timestamp":"{}{})", number, timestamp,
                       tails[static_cast<std::size_t>(number) % tails.size()]);
}

std::string timestamp_now() {
    constexpr std::string_view kKey = R"("timestamp":")";
    cli::RobotState state;
    state.sent_us = cli::system_us();
    const std::string text = cli::json_of(state);
    const std::size_t begin = text.find(kKey) + kKey.size();
    return text.substr(begin, text.find('"', begin) - begin);
}

}  // namespace dotpose::test
