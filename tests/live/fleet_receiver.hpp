/// A fleet that receives messages at simulated times, without a broker.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "fleet_state.hpp"
#include "robot_message.hpp"

namespace dotpose::test {

inline constexpr std::int64_t kSecond = 1'000'000;
inline constexpr std::int64_t kEpoch_us = 1'795'000'000 * kSecond;  // 2026-11-18

class Receiver {
  public:
    /// Receives a state at the current time. The robot sent the state `delay_us` ago, and its clock
    /// is `skew_us` ahead.
    void receive(Message message, std::int64_t delay_us = 0, std::int64_t skew_us = 0) {
        message.header_id = number_++;
        message.time = timestamp(now().system_us - delay_us + skew_us);
        fleet.take(state_topic(message.robot), message.json(), now());
    }
    void connect(const std::string& robot, const std::string& state, std::int64_t sent_ago_us = 0) {
        fleet.take(connection_topic(robot),
                   connection_json(state, timestamp(now().system_us - sent_ago_us)), now());
    }
    void pass(double seconds) { elapsed_us_ += static_cast<std::int64_t>(seconds * 1e6); }
    /// Advances the time as if the broker were unreachable: `Now::watched_us` does not change.
    void pass_blind(double seconds) {
        pass(seconds);
        blind_us_ += static_cast<std::int64_t>(seconds * 1e6);
    }
    cli::Now now() const {
        return {kEpoch_us + elapsed_us_, 50 * kSecond + elapsed_us_ - blind_us_};
    }
    cli::FleetRobot robot(const std::string& name) const {
        for (const auto& [known, robot] : fleet.robots(now())) {
            if (known == name) return robot;
        }
        throw std::runtime_error("no robot " + name);
    }
    cli::Condition condition(const std::string& name) const { return robot(name).condition; }

    cli::FleetState fleet;

  private:
    std::int64_t elapsed_us_ = 0;
    std::int64_t blind_us_ = 0;
    int number_ = 0;
};

}  // namespace dotpose::test
