#include "fleet_metrics.hpp"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "metrics_text.hpp"

namespace dotpose::cli {
namespace {

void add_conditions(MetricsText& text, const FleetRobots& robots, const FleetMap& map) {
    std::array<int, kConditionCount> counts{};
    for (const auto& [name, robot] : robots)
        ++counts[static_cast<std::size_t>(robot.condition)];
    text.begin("dotpose_fleet_robots", "gauge", "Number of robots by state.");
    for (int i = 0; i < kConditionCount; ++i) {
        text.add(counts[static_cast<std::size_t>(i)],
                 label("state", name_of(static_cast<Condition>(i))));
    }
    text.gauge("dotpose_fleet_robots_on_unknown_sheets",
               "Number of robots on maps or sheets that the sheet file does not contain.",
               std::ranges::count_if(
                   robots, [&map](const auto& entry) { return !map.has_place_of(entry.second); }));
}

void add_messages(MetricsText& text, const FleetState& fleet, Delivery delivery) {
    const StateCounts counts = fleet.counts();
    text.counter("dotpose_fleet_states_total", "States received.", counts.messages);
    text.counter("dotpose_fleet_bad_messages_total", "Messages that are not valid.", fleet.bad());
    text.counter("dotpose_fleet_late_states_total", "States that arrived after newer states.",
                 counts.late);
    text.counter("dotpose_fleet_repeated_states_total", "States that arrived before.",
                 counts.repeated);
    if (delivery == Delivery::shared) return;
    text.gauge("dotpose_fleet_missed_states",
               "States that did not arrive, by their numbers. States that arrive later are "
               "subtracted.",
               counts.missed);
}

void add_latency(MetricsText& text, const LatencyHistogram& latency) {
    text.begin("dotpose_fleet_latency_seconds", "histogram",
               "Time from sending a state to receiving it, by the clocks of both computers.");
    std::int64_t count = 0;
    for (std::size_t i = 0; i < latency.kLimits_s.size(); ++i) {
        count += latency.counts[i];
        text.add(count, label("le", fmt::format("{}", latency.kLimits_s[i])), "_bucket");
    }
    count += latency.counts.back();
    text.add(count, R"(le="+Inf")", "_bucket");
    text.add(latency.sum_s, {}, "_sum");
    text.add(count, {}, "_count");
}

void add_frames(MetricsText& text, const CameraTotals& totals) {
    text.counter("dotpose_fleet_frames_total", "Camera frames of all robots.", totals.frames);
    text.begin("dotpose_fleet_refused_frames_total", "counter",
               "Camera frames without a fix, by status.");
    for (int i = 1; i < kStatusCount; ++i) {
        text.add(totals.refused[static_cast<std::size_t>(i)],
                 label("reason", name(static_cast<Status>(i))));
    }
    text.add(totals.refused.back(), label("reason", name(Status::other)));
}

void add_services(MetricsText& text, const FleetServices& services) {
    if (services.is_broker_connected) {
        text.gauge("dotpose_fleet_broker_connected", "1 if the broker is connected, otherwise 0.",
                   *services.is_broker_connected ? 1 : 0);
    }
    if (!services.store) return;
    text.gauge("dotpose_fleet_store_connected",
               "1 if the newest transaction of the database succeeded, otherwise 0.",
               services.store->is_away ? 0 : 1);
    text.gauge("dotpose_fleet_store_waiting_states", "States that wait for the database.",
               services.store->waiting);
    text.counter("dotpose_fleet_stored_states_total", "States written to the database.",
                 services.store->stored);
    text.counter("dotpose_fleet_store_dropped_states_total",
                 "States that were dropped because the database was away.",
                 services.store->dropped);
}

void add_robots(MetricsText& text, const FleetRobots& robots) {
    text.begin("dotpose_robot_state", "gauge", "1 for the state of each robot.");
    for (const auto& [name, robot] : robots)
        text.add(1, label("robot", name) + ',' + label("state", name_of(robot.condition)));
    text.begin("dotpose_robot_silence_seconds", "gauge",
               "Age of the newest message of each robot.");
    for (const auto& [name, robot] : robots)
        text.add(static_cast<double>(robot.silence_us) * 1e-6, label("robot", name));
    text.begin("dotpose_robot_camera_frames_per_second", "gauge", "Frame rate of each camera.");
    for (const auto& [name, robot] : robots) {
        if (robot.camera) text.add(robot.camera->rate_hz, label("robot", name));
    }
}

}  // namespace

std::string metrics_text(const FleetState& fleet, const FleetRobots& robots, const FleetMap& map,
                         const FleetServices& services) {
    MetricsText text;
    add_conditions(text, robots, map);
    add_messages(text, fleet, services.delivery);
    add_latency(text, fleet.latency_histogram());
    add_frames(text, fleet.camera_totals());
    add_services(text, services);
    add_robots(text, robots);
    return std::move(text).finish();
}

}  // namespace dotpose::cli
