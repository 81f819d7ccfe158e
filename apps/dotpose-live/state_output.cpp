#include "state_output.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "mqtt_options.hpp"
#include "robot_state.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

publish::MqttOptions with_presence(const PublishArguments& arguments) {
    publish::MqttOptions mqtt = *mqtt_options(arguments.mqtt);
    mqtt.presence_topic = topic_of(arguments.robot, Subject::connection);
    mqtt.presence = [robot = arguments.robot,
                     messages = std::uint64_t{0}](publish::Presence presence) mutable {
        return json_of(RobotConnection{robot, messages++, system_us(), presence});
    };
    return mqtt;
}

}  // namespace

void CameraCounter::count(const Reading& reading) {
    if (total_.frames++ == 0) {
        reported_us_ = reading.time_us;
        // The rate is based on the number of intervals between frames. No interval precedes the
        // first frame, so the first frame is not counted.
        reported_frames_ = total_.frames;
    }
    newest_us_ = reading.time_us;
    const Status status = reading.record.fix.status;
    if (status == Status::ok) return;
    ++total_.refused[std::min(static_cast<std::size_t>(status), total_.refused.size() - 1)];
}

std::optional<CameraReport> CameraCounter::take_report() {
    constexpr std::int64_t kBetween_us = 1'000'000;
    const std::int64_t elapsed_us = newest_us_ - reported_us_;
    if (elapsed_us < kBetween_us) return std::nullopt;
    total_.rate_hz = 1e6 * static_cast<double>(total_.frames - reported_frames_) /
                     static_cast<double>(elapsed_us);
    reported_us_ = newest_us_;
    reported_frames_ = total_.frames;
    return total_;
}

StateSource::StateSource(std::string robot, const std::string& sheets, double max_rate_hz)
    : robot_(std::move(robot)),
      world_map_(std::filesystem::path(sheets).stem().string()),
      period_us_(max_rate_hz > 0 ? std::llround(1e6 / max_rate_hz) : 0),
      next_us_(std::numeric_limits<std::int64_t>::min()) {}

std::optional<RobotState> StateSource::next(const Reading& reading) {
    camera_.count(reading);
    const TrackEvents& events = reading.track.events;
    const bool is_event =
        events.fix || events.lost || events.kidnapped || events.stationary || events.moving;
    if (reading.time_us < next_us_ && !is_event) return std::nullopt;
    next_us_ = reading.time_us + period_us_;
    RobotState state = state_of(reading, robot_, world_map_);
    state.header_id = states_++;
    state.camera = camera_.take_report();
    return state;
}

StateOutput::StateOutput(const PublishArguments& arguments, const std::string& sheets)
    : states_(arguments.robot, sheets, arguments.max_rate_hz),
      publisher_(with_presence(arguments)) {}

void StateOutput::finish() {
    constexpr auto kPatience = std::chrono::seconds(2);
    publisher_.flush(kPatience);
    notify(fmt::format("{} states published, {} dropped", publisher_.sent(),
                       publisher_.dropped() + publisher_.unsent()));
    publisher_.require_reached();
}

void StateOutput::take(const Reading& reading) {
    if (const auto state = states_.next(reading))
        publisher_.publish(topic_of(state->robot, Subject::visualization), json_of(*state));
}

std::unique_ptr<ReadingSink> open_publisher(const PublishArguments& arguments,
                                            const std::string& sheets) {
    if (arguments.mqtt.url.empty()) return nullptr;
    return std::make_unique<StateOutput>(arguments, sheets);
}

}  // namespace dotpose::cli
