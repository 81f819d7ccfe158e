#include "robot_state.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "reading_fields.hpp"

namespace dotpose::cli {
namespace {

constexpr std::int64_t kMicro = 1'000'000;

/// ISO 8601 in UTC, with microseconds.
std::string timestamp(std::int64_t time_us) {
    const auto seconds = static_cast<std::time_t>(time_us / kMicro);
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z", utc.tm_year + 1900,
                       utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                       time_us % kMicro);
}

std::int64_t parse_timestamp(const std::string& text) {
    std::tm utc{};
    double seconds = 0;
    if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf", &utc.tm_year, &utc.tm_mon,
                    &utc.tm_mday, &utc.tm_hour, &utc.tm_min, &seconds) != 6) {
        return 0;
    }
    utc.tm_year -= 1900;
    utc.tm_mon -= 1;
    return std::int64_t{timegm(&utc)} * kMicro + std::llround(seconds * 1e6);
}

}  // namespace

std::string state_topic(const std::string& robot) {
    return fmt::format("{}/{}/state", kTopicRoot, robot);
}

std::int64_t system_us() {
    using namespace std::chrono;
    return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
}

RobotState state_of(const Reading& reading, const std::string& robot,
                    const std::string& world_map) {
    const Track& track = reading.track;
    const TrackedPose& pose = track.pose;
    RobotState state;
    state.robot = robot;
    state.sent_us = system_us();
    state.state = state_name(track);
    state.map_id =
        reading.plane == Plane::sheet_world ? world_map : fmt::format("pattern-{}", pose.plane);
    state.is_localized = !track.is_lost;
    if (track.is_lost) return state;
    state.x_m = pose.x_mm() / 1000;
    state.y_m = pose.y_mm() / 1000;
    state.theta_rad = pose.theta_rad();
    state.deviation_m =
        std::sqrt(static_cast<double>(std::max(pose.covariance[0][0], pose.covariance[1][1]))) /
        1000;
    state.vx_m_s = static_cast<double>(pose.vx_mm_s) / 1000;
    state.vy_m_s = static_cast<double>(pose.vy_mm_s) / 1000;
    state.omega_rad_s = static_cast<double>(pose.turn_rad_s);
    return state;
}

std::string json_of(const RobotState& state) {
    nlohmann::ordered_json json = {
        {"headerId", state.header_id}, {"timestamp", timestamp(state.sent_us)},
        {"version", "2.0.0"},          {"manufacturer", "dotpose"},
        {"serialNumber", state.robot}, {"state", state.state}};
    nlohmann::ordered_json position = {{"positionInitialized", state.is_localized},
                                       {"localized", state.is_localized},
                                       {"mapId", state.map_id}};
    if (state.is_localized) {
        position["x"] = state.x_m;
        position["y"] = state.y_m;
        position["theta"] = state.theta_rad;
        position["deviationRange"] = state.deviation_m;
        json["velocity"] = {
            {"vx", state.vx_m_s}, {"vy", state.vy_m_s}, {"omega", state.omega_rad_s}};
    }
    json["agvPosition"] = position;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<RobotState> parse_state(const std::string& text) {
    try {
        const auto json = nlohmann::json::parse(text);
        RobotState state;
        state.robot = json.at("serialNumber");
        // It is shown on terminals.
        if (std::ranges::any_of(state.robot, [](unsigned char c) { return c < ' '; })) {
            return std::nullopt;
        }
        state.header_id = json.at("headerId");
        state.sent_us = parse_timestamp(json.at("timestamp"));
        state.state = json.at("state");
        const auto& position = json.at("agvPosition");
        state.is_localized = position.at("localized");
        state.map_id = position.at("mapId");
        if (!state.is_localized) return state;
        state.x_m = position.at("x");
        state.y_m = position.at("y");
        state.theta_rad = position.at("theta");
        state.deviation_m = position.at("deviationRange");
        const auto& velocity = json.at("velocity");
        state.vx_m_s = velocity.at("vx");
        state.vy_m_s = velocity.at("vy");
        state.omega_rad_s = velocity.at("omega");
        return state;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

}  // namespace dotpose::cli
