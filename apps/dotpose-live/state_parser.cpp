// Parses state messages with simdjson, which is ten times faster than the JSON library used
// elsewhere. `dotpose fleet` may receive tens of thousands of messages per second.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <new>
#include <optional>
#include <string>
#include <string_view>

#include <simdjson.h>

#include "files/input_file.hpp"
#include "state_message.hpp"

namespace dotpose::cli {
namespace {

using simdjson::dom::object;

/// Maximum size of a message, in bytes.
constexpr std::size_t kMaxBytes = 1 << 16;

/// Parses `count` digits starting at index `first`. `text` must be long enough. Returns -1 if any
/// of the characters is not a digit.
int digits(std::string_view text, std::size_t first, std::size_t count) {
    int value = -1;
    const char* const begin = text.data() + first;
    const auto [stop, error] = std::from_chars(begin, begin + count, value);
    return error == std::errc() && stop == begin + count ? value : -1;
}

/// Converts a fraction of a second, such as ".123456", to microseconds. Returns 0 for an empty
/// string, and nullopt for any other text.
std::optional<std::int64_t> parse_decimals_us(std::string_view text) {
    if (text.empty()) return 0;
    double fraction_s = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, fraction_s);
    const bool is_fraction = text.find_first_not_of(".0123456789") == std::string_view::npos;
    if (error != std::errc() || stop != end || !is_fraction || text.front() != '.') {
        return std::nullopt;
    }
    return std::llround(fraction_s * 1e6);
}

/// Thrown if a value in a message is out of range.
struct OutOfRange {};

/// Returns a number in a message. Throws simdjson_error if the value is missing or is not a number,
/// and OutOfRange if its absolute value exceeds `max_magnitude`.
double bounded(const object& values, std::string_view key, double max_magnitude) {
    const double value = values[key].get_double();
    if (!(std::abs(value) <= max_magnitude)) throw OutOfRange();
    return value;
}

std::string name_in(const object& values, std::string_view key) {
    const std::string_view name = values[key].get_string();
    if (name.size() > kMaxNameBytes) throw OutOfRange();
    return std::string(name);
}

/// Returns a name, or an empty string if the message does not contain it.
std::string optional_name_in(const object& values, std::string_view key) {
    return values[key].error() == simdjson::NO_SUCH_FIELD ? std::string() : name_in(values, key);
}

/// Returns the index in RefusedFrames for the name of a status. Returns the index of Status::other
/// if the name is unknown.
std::size_t refused_index(std::string_view text) {
    std::size_t i = 0;
    while (i < static_cast<std::size_t>(kStatusCount) && name(static_cast<Status>(i)) != text)
        ++i;
    return i;
}

/// Returns the camera report in a message, or nullopt if there is none.
std::optional<CameraReport> camera_in(const object& message) {
    constexpr double kMax_hz = 1e5;
    object values;
    if (message["camera"].get(values) != simdjson::SUCCESS) return std::nullopt;
    CameraReport camera;
    camera.rate_hz = bounded(values, "rate", kMax_hz);
    camera.frames = values["frames"].get_uint64();
    for (const auto& [reason, count] : values["refused"].get_object())
        camera.refused[refused_index(reason)] = count.get_uint64();
    return camera;
}

/// Returns a rotation as a unit quaternion. Throws OutOfRange if its norm is not close to 1.
Quaternion rotation_in(const object& values) {
    constexpr double kMaxError = 1e-3;
    const Quaternion q{bounded(values, "w", 1), bounded(values, "x", 1), bounded(values, "y", 1),
                       bounded(values, "z", 1)};
    const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(std::abs(norm - 1) <= kMaxError)) throw OutOfRange();
    return {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
}

/// Returns the pose of the tracked camera or, if it is missing, the camera pose that was computed
/// from the newest frame. Returns nullopt if the message contains neither pose.
std::optional<CameraInWorld> camera_pose_in(const object& message, double max_m) {
    object values;
    if (message["cameraTrack"].get(values) != simdjson::SUCCESS &&
        message["cameraPose"].get(values) != simdjson::SUCCESS)
        return std::nullopt;
    CameraInWorld pose;
    pose.x_m = bounded(values, "x", max_m);
    pose.y_m = bounded(values, "y", max_m);
    pose.z_m = bounded(values, "z", max_m);
    pose.rotation = rotation_in(values["orientation"].get_object());
    return pose;
}

std::int64_t time_in(const object& message) {
    const auto sent_us = parse_timestamp(message["timestamp"].get_string());
    if (!sent_us) throw OutOfRange();
    return *sent_us;
}

RobotState state_in(const object& message) {
    constexpr double kMax_m = 1e6;
    constexpr double kMax_m_s = 1e4;
    constexpr double kMax_rad = 1e4;
    RobotState state;
    state.sent_us = time_in(message);
    state.header_id = message["headerId"].get_uint64();
    state.state = name_in(message, "state");
    state.reason = optional_name_in(message, "reason");
    state.sheet = optional_name_in(message, "sheet");
    state.camera = camera_in(message);
    object position;
    state.is_localized = message["agvPosition"].get(position) == simdjson::SUCCESS;
    if (!state.is_localized) return state;
    state.map_id = name_in(position, "mapId");
    state.x_m = bounded(position, "x", kMax_m);
    state.y_m = bounded(position, "y", kMax_m);
    state.theta_rad = bounded(position, "theta", kMax_rad);
    state.deviation_m = bounded(position, "deviationRange", kMax_m);
    const object velocity = message["velocity"].get_object();
    state.vx_m_s = bounded(velocity, "vx", kMax_m_s);
    state.vy_m_s = bounded(velocity, "vy", kMax_m_s);
    state.omega_rad_s = bounded(velocity, "omega", kMax_rad);
    state.camera_pose = camera_pose_in(message, kMax_m);
    return state;
}

RobotConnection connection_in(const object& message) {
    RobotConnection connection;
    connection.sent_us = time_in(message);
    connection.header_id = message["headerId"].get_uint64();
    const std::string_view state = message["connectionState"].get_string();
    const auto known = std::ranges::find(kConnectionStates, state);
    if (known == std::end(kConnectionStates)) throw OutOfRange();
    connection.presence = static_cast<publish::Presence>(known - std::begin(kConnectionStates));
    return connection;
}

/// Returns a parser that reuses its memory for all messages.
simdjson::dom::parser make_parser() {
    simdjson::dom::parser parser(kMaxBytes);
    if (parser.allocate(kMaxBytes, files::kMaxJsonDepth) != simdjson::SUCCESS) {
        throw std::bad_alloc();
    }
    return parser;
}

/// Returns `read(message)`, or nullopt if the message is invalid.
template <typename Read>
auto parsed(std::string_view json, const Read& read) -> std::optional<decltype(read(object()))> {
    // An empty message, which removes a robot, may have a null data pointer. The parser must not
    // copy from a null pointer.
    if (json.empty()) return std::nullopt;
    thread_local simdjson::dom::parser parser = make_parser();
    try {
        return read(parser.parse(json.data(), json.size()).get_object());
    } catch (const simdjson::simdjson_error&) {
        return std::nullopt;
    } catch (const OutOfRange&) {
        return std::nullopt;
    }
}

}  // namespace

std::optional<std::int64_t> parse_timestamp(std::string_view text) {
    using namespace std::chrono;
    constexpr std::string_view kSeconds = "2026-11-24T16:20:00";
    if (text.size() <= kSeconds.size() || !text.ends_with('Z')) return std::nullopt;
    for (const std::size_t i : {4U, 7U, 10U, 13U, 16U}) {
        if (text[i] != kSeconds[i]) return std::nullopt;
    }
    const int in_year = digits(text, 0, 4);
    const int in_month = digits(text, 5, 2);
    const int in_day = digits(text, 8, 2);
    const int hour = digits(text, 11, 2);
    const int minute = digits(text, 14, 2);
    const int second = digits(text, 17, 2);
    if (in_year < 1970 || in_month < 1 || in_month > 12 || in_day < 1 || in_day > 31 || hour < 0 ||
        hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 60) {
        return std::nullopt;
    }
    std::string_view decimals = text.substr(kSeconds.size());
    decimals.remove_suffix(1);
    const auto fraction_us = parse_decimals_us(decimals);
    if (!fraction_us) return std::nullopt;
    const sys_days date =
        year(in_year) / month(static_cast<unsigned>(in_month)) / day(static_cast<unsigned>(in_day));
    const auto time = date + hours(hour) + minutes(minute) + seconds(second);
    return microseconds(time.time_since_epoch()).count() + *fraction_us;
}

std::optional<RobotState> parse_state(std::string_view json) {
    return parsed(json, state_in);
}

std::optional<RobotConnection> parse_connection(std::string_view json) {
    return parsed(json, connection_in);
}

}  // namespace dotpose::cli
