#include "fleet_input.hpp"

#include <chrono>

namespace dotpose::cli {
namespace {

std::int64_t monotonic_us() {
    using namespace std::chrono;
    return duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

WatchedClock::WatchedClock() : observed_us_(monotonic_us()) {}

void WatchedClock::observe(bool is_connected) {
    const std::int64_t now_us = monotonic_us();
    if (!is_connected) blind_us_ += now_us - observed_us_;
    observed_us_ = now_us;
}

Now WatchedClock::now() const {
    return {system_us(), monotonic_us() - blind_us_};
}

FleetInput::FleetInput(const FleetInputOptions& options, FleetStore* store)
    : shard_(options.share.shard()),
      store_(store),
      fleet_([this](std::string_view robot, const RobotState& state) { record(robot, state); },
             options.limits) {
    if (!options.log.empty()) log_.emplace(options.log);
    subscriber_.emplace(
        options.mqtt, options.share.topics(),
        [this](std::string_view topic, std::string_view payload) { take(topic, payload); });
}

void FleetInput::flush() {
    if (log_) log_->flush();
}

void FleetInput::finish() {
    subscriber_->disconnect();
    flush();
}

void FleetInput::take(std::string_view topic, std::string_view payload) {
    const auto sender = parse_topic(topic);
    if (sender && !shard_.has(sender->robot)) return;
    const Now now = clock_.now();
    received_us_ = now.system_us;
    fleet_.take(topic, payload, now);
}

void FleetInput::record(std::string_view robot, const RobotState& state) {
    if (log_) log_->add(robot, state, received_us_);
    if (store_ != nullptr) store_->add(robot, state, received_us_);
}

}  // namespace dotpose::cli
