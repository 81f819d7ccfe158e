#include "robot_state.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "dotpose/files/error.hpp"
#include "dotpose/tools/track_names.hpp"
#include "files/input_file.hpp"
#include "reading_fields.hpp"

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

/// Parses `count` digits of a text that is long enough; returns -1 if they are not digits.
int digits(std::string_view text, std::size_t first, std::size_t count) {
    int value = -1;
    const char* const begin = text.data() + first;
    const auto [stop, error] = std::from_chars(begin, begin + count, value);
    return error == std::errc() && stop == begin + count ? value : -1;
}

/// Parses a time such as "2026-11-24T16:20:00.123456Z", with any number of decimals or none.
/// Returns none for any other text.
std::optional<std::int64_t> parse_timestamp(std::string_view text) {
    constexpr std::string_view kSeconds = "2026-11-24T16:20:00";
    if (text.size() <= kSeconds.size() || !text.ends_with('Z')) return std::nullopt;
    for (const std::size_t i : {4U, 7U, 10U, 13U, 16U}) {
        if (text[i] != kSeconds[i]) return std::nullopt;
    }
    std::tm utc{};
    const int year = digits(text, 0, 4);
    const int month = digits(text, 5, 2);
    utc.tm_mday = digits(text, 8, 2);
    utc.tm_hour = digits(text, 11, 2);
    utc.tm_min = digits(text, 14, 2);
    utc.tm_sec = digits(text, 17, 2);
    if (year < 1970 || month < 1 || month > 12 || utc.tm_mday < 1 || utc.tm_mday > 31 ||
        utc.tm_hour < 0 || utc.tm_hour > 23 || utc.tm_min < 0 || utc.tm_min > 59 ||
        utc.tm_sec < 0 || utc.tm_sec > 60) {
        return std::nullopt;
    }
    utc.tm_year = year - 1900;
    utc.tm_mon = month - 1;
    std::string_view decimals = text.substr(kSeconds.size());
    decimals.remove_suffix(1);
    double fraction_s = 0;
    if (!decimals.empty()) {
        const char* const end = decimals.data() + decimals.size();
        const auto [stop, error] = std::from_chars(decimals.data(), end, fraction_s);
        const bool is_fraction = decimals.find_first_not_of(".0123456789") == std::string::npos;
        if (error != std::errc() || stop != end || !is_fraction || decimals.front() != '.') {
            return std::nullopt;
        }
    }
    return std::int64_t{timegm(&utc)} * kMicro + std::llround(fraction_s * 1e6);
}

/// Returns a number of a message. Throws json::exception if there is none, and Error if its
/// absolute value is above `most`.
double bounded(const nlohmann::json& object, const char* key, double most) {
    const double value = object.at(key);
    if (!(std::abs(value) <= most)) throw Error(fmt::format("{} is absurd", key));
    return value;
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

std::optional<std::string> robot_of(std::string_view topic) {
    const std::string prefix = std::string(kTopicRoot) + '/';
    constexpr std::string_view kSuffix = "/state";
    if (!topic.starts_with(prefix) || !topic.ends_with(kSuffix)) return std::nullopt;
    topic.remove_prefix(prefix.size());
    if (topic.size() <= kSuffix.size()) return std::nullopt;
    topic.remove_suffix(kSuffix.size());
    if (topic.size() > kMostNameBytes || topic.find('/') != std::string_view::npos) {
        return std::nullopt;
    }
    return std::string(topic);
}

std::optional<RobotState> parse_state(const std::string& text) {
    constexpr double kMost_m = 1e6;
    constexpr double kMost_m_s = 1e4;
    constexpr double kMost_rad = 1e4;
    try {
        const auto json = files::parse_json(text);
        RobotState state;
        const auto& id = json.at("headerId");
        const auto sent_us = parse_timestamp(json.at("timestamp").get<std::string>());
        if (!id.is_number_unsigned() || !sent_us) return std::nullopt;
        state.header_id = id;
        state.sent_us = *sent_us;
        state.state = json.at("state");
        const auto& position = json.at("agvPosition");
        state.is_localized = position.at("localized");
        state.map_id = position.at("mapId");
        if (state.state.size() > kMostNameBytes || state.map_id.size() > kMostNameBytes) {
            return std::nullopt;
        }
        if (!state.is_localized) return state;
        state.x_m = bounded(position, "x", kMost_m);
        state.y_m = bounded(position, "y", kMost_m);
        state.theta_rad = bounded(position, "theta", kMost_rad);
        state.deviation_m = bounded(position, "deviationRange", kMost_m);
        const auto& velocity = json.at("velocity");
        state.vx_m_s = bounded(velocity, "vx", kMost_m_s);
        state.vy_m_s = bounded(velocity, "vy", kMost_m_s);
        state.omega_rad_s = bounded(velocity, "omega", kMost_rad);
        return state;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace dotpose::cli
