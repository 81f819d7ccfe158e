#include "state_message.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace dotpose::cli {
namespace {

constexpr std::int64_t kMicro = 1'000'000;

/// Subject names as used in topics, indexed by Subject.
constexpr std::string_view kSubjects[] = {"visualization", "connection"};

/// Returns the JSON members at the start of every message.
nlohmann::ordered_json header(const std::string& robot, std::uint64_t id, std::int64_t sent_us) {
    return {{"headerId", id},
            {"timestamp", timestamp(sent_us)},
            {"version", "2.0.0"},
            {"manufacturer", "dotpose"},
            {"serialNumber", robot}};
}

nlohmann::ordered_json json_of(const CameraReport& camera) {
    nlohmann::ordered_json refused = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < camera.refused.size(); ++i) {
        const Status status =
            i < static_cast<std::size_t>(kStatusCount) ? static_cast<Status>(i) : Status::other;
        if (camera.refused[i] > 0) refused[name(status)] = camera.refused[i];
    }
    return {{"rate", camera.rate_hz}, {"frames", camera.frames}, {"refused", std::move(refused)}};
}

nlohmann::ordered_json json_of(const CameraInWorld& camera) {
    const Quaternion& q = camera.rotation;
    nlohmann::ordered_json covariance = nlohmann::ordered_json::array();
    for (const auto& row : camera.covariance) {
        for (const double value : row)
            covariance.push_back(value);
    }
    return {{"x", camera.x_m},
            {"y", camera.y_m},
            {"z", camera.z_m},
            {"orientation", {{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}}},
            {"covariance", std::move(covariance)}};
}

nlohmann::ordered_json json_of(const CameraMotion& motion) {
    nlohmann::ordered_json json = json_of(motion.pose);
    const auto& [vx, vy, vz] = motion.velocity_m_s;
    const auto& [turn_x, turn_y, turn_z] = motion.turn_rad_s;
    json["velocity"] = {{"x", vx}, {"y", vy}, {"z", vz}};
    json["turn"] = {{"x", turn_x}, {"y", turn_y}, {"z", turn_z}};
    return json;
}

std::string dump(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string timestamp(std::int64_t time_us) {
    const auto seconds = static_cast<std::time_t>(time_us / kMicro);
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z", utc.tm_year + 1900,
                       utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                       time_us % kMicro);
}

std::string topic_of(const std::string& robot, Subject subject) {
    return fmt::format("{}/{}/{}", kTopicRoot, robot, kSubjects[static_cast<int>(subject)]);
}

std::int64_t system_us() {
    using namespace std::chrono;
    return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
}

std::string json_of(const RobotState& state) {
    nlohmann::ordered_json json = header(state.robot, state.header_id, state.sent_us);
    // Additional members, which VDA 5050 permits: state, reason, sheet, camera, cameraPose and
    // cameraTrack.
    json["state"] = state.state;
    if (!state.reason.empty()) json["reason"] = state.reason;
    if (!state.sheet.empty()) json["sheet"] = state.sheet;
    if (state.camera) json["camera"] = json_of(*state.camera);
    if (state.is_localized) {
        json["agvPosition"] = {{"positionInitialized", true},
                               {"mapId", state.map_id},
                               {"x", state.x_m},
                               {"y", state.y_m},
                               {"theta", std::remainder(state.theta_rad, 2 * std::numbers::pi)},
                               {"deviationRange", state.deviation_m}};
        json["velocity"] = {
            {"vx", state.vx_m_s}, {"vy", state.vy_m_s}, {"omega", state.omega_rad_s}};
        if (state.camera_pose) json["cameraPose"] = json_of(*state.camera_pose);
        if (state.camera_track) json["cameraTrack"] = json_of(*state.camera_track);
    }
    return dump(json);
}

std::string json_of(const RobotConnection& connection) {
    nlohmann::ordered_json json =
        header(connection.robot, connection.header_id, connection.sent_us);
    json["connectionState"] = kConnectionStates[static_cast<int>(connection.presence)];
    return dump(json);
}

std::string json_of(const RobotAlert& alert) {
    nlohmann::ordered_json json = header(alert.robot, alert.header_id, alert.sent_us);
    json["condition"] = alert.condition;
    if (!alert.previous.empty()) json["previous"] = alert.previous;
    if (!alert.reason.empty()) json["reason"] = alert.reason;
    if (!alert.map_id.empty()) {
        json["mapId"] = alert.map_id;
        if (!alert.sheet.empty()) json["sheet"] = alert.sheet;
        json["x"] = alert.x_m;
        json["y"] = alert.y_m;
    }
    return dump(json);
}

std::optional<MessageTopic> parse_topic(std::string_view topic) {
    constexpr std::string_view kRoot = kTopicRoot;
    if (!topic.starts_with(kRoot)) return std::nullopt;
    topic.remove_prefix(kRoot.size());
    if (!topic.starts_with('/')) return std::nullopt;
    topic.remove_prefix(1);
    const std::size_t slash = topic.find('/');
    if (slash == 0 || slash == std::string_view::npos || slash > kMaxNameBytes) {
        return std::nullopt;
    }
    const auto subject = std::ranges::find(kSubjects, topic.substr(slash + 1));
    if (subject == std::end(kSubjects)) return std::nullopt;
    return MessageTopic{topic.substr(0, slash),
                        static_cast<Subject>(subject - std::begin(kSubjects))};
}

}  // namespace dotpose::cli
