#include "state_message.hpp"

#include <chrono>
#include <ctime>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace dotpose::cli {
namespace {

constexpr std::int64_t kMicro = 1'000'000;

/// Formats a time by ISO 8601 in UTC, with microseconds.
std::string timestamp(std::int64_t time_us) {
    const auto seconds = static_cast<std::time_t>(time_us / kMicro);
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z", utc.tm_year + 1900,
                       utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                       time_us % kMicro);
}

}  // namespace

std::string state_topic(const std::string& robot) {
    return fmt::format("{}/{}/state", kTopicRoot, robot);
}

std::int64_t system_us() {
    using namespace std::chrono;
    return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
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
    if (state.is_will) json["connectionState"] = kBroken;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<std::string_view> robot_of(std::string_view topic) {
    constexpr std::string_view kRoot = kTopicRoot;
    constexpr std::string_view kSuffix = "/state";
    if (!topic.starts_with(kRoot) || !topic.ends_with(kSuffix)) return std::nullopt;
    topic.remove_prefix(kRoot.size());
    if (!topic.starts_with('/') || topic.size() <= kSuffix.size() + 1) return std::nullopt;
    topic.remove_prefix(1);
    topic.remove_suffix(kSuffix.size());
    if (topic.size() > kMostNameBytes || topic.find('/') != std::string_view::npos) {
        return std::nullopt;
    }
    return topic;
}

}  // namespace dotpose::cli
