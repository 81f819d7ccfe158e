/// Robot messages, written independently of the code under test.
#pragma once

#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>

#include <nlohmann/json.hpp>

namespace dotpose::test {

struct Message {
    std::string robot = {};
    int header_id = 0;
    std::string time = {};
    std::string state = "moving";
    bool is_localized = true;
    double x_m = 0;
    double y_m = 0;
    std::string map = "table";
    std::string sheet = {};
    std::string reason = {};
    nlohmann::json camera = {};

    std::string json() const {
        nlohmann::json message = {{"headerId", header_id},
                                  {"timestamp", time},
                                  {"serialNumber", robot},
                                  {"state", state}};
        if (!sheet.empty()) message["sheet"] = sheet;
        if (!reason.empty()) message["reason"] = reason;
        if (!camera.is_null()) message["camera"] = camera;
        if (is_localized) {
            message["agvPosition"] = {
                {"mapId", map}, {"x", x_m}, {"y", y_m}, {"theta", 0}, {"deviationRange", 1e-6}};
            message["velocity"] = {{"vx", 0}, {"vy", 0.5}, {"omega", 0}};
        }
        return message.dump();
    }
};

inline std::string state_topic(const std::string& robot) {
    return "uagv/v2/dotpose/" + robot + "/visualization";
}

inline std::string connection_topic(const std::string& robot) {
    return "uagv/v2/dotpose/" + robot + "/connection";
}

/// Converts a time in microseconds since 1970 to the format used in messages.
inline std::string timestamp(std::int64_t us) {
    const std::time_t seconds = us / 1'000'000;
    char text[40];
    const std::size_t size = std::strftime(text, sizeof text, "%FT%T", std::gmtime(&seconds));
    std::snprintf(text + size, sizeof text - size, ".%06dZ", static_cast<int>(us % 1'000'000));
    return text;
}

inline std::string time_now() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return timestamp(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

inline std::string connection_json(const std::string& state, const std::string& time) {
    return nlohmann::json({{"headerId", 0}, {"timestamp", time}, {"connectionState", state}})
        .dump();
}

}  // namespace dotpose::test
