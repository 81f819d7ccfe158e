/// Compares the fields of the element's messages with those in the output lines of `dotpose watch`
/// for the same frames.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dotpose::test {

/// Returns the maximum rounding error of the field `key` in a line that `dotpose watch` writes.
inline double rounding_of(std::string_view key, double value) {
    constexpr double kHalf = 0.501;
    if (key.starts_with("covariance") || key.starts_with("track_covariance")) {
        return 1e-6 * std::abs(value);
    }
    if (key == "p_wrong" || key == "code_p_wrong") return 0.01 * value;
    if (key.ends_with("_s")) return kHalf * 1e-3;
    if (key.ends_with("_px")) return kHalf * 1e-4;
    if (key == "yaw_rad") return kHalf * 1e-8;
    if (key.ends_with("_m")) return kHalf * 1e-9;
    return kHalf * 1e-6;
}

/// Returns true for fields that occur in lines but not in messages. The element omits these values,
/// or reports them in other units or fields.
inline bool is_only_in_lines(std::string_view key) {
    constexpr std::array<std::string_view, 7> kKeys = {"schema", "t_s",        "x_grid", "y_grid",
                                                       "file",   "elapsed_us", "warning"};
    return key.starts_with("other_x") || key.starts_with("other_y") || key.starts_with("code_x") ||
           key.starts_with("code_y") || std::ranges::find(kKeys, key) != kKeys.end();
}

inline void expect_value_of(const std::string& key, const nlohmann::json& line,
                            const nlohmann::json& told) {
    if (line.is_array()) {
        ASSERT_EQ(line.size(), told.size()) << key;
        for (std::size_t i = 0; i < line.size(); ++i)
            expect_value_of(key, line[i], told[i]);
    } else if (line.is_string()) {
        // If there is no fix, the `message` field is more detailed in the line than in the
        // element's message.
        if (key != "message") {
            EXPECT_EQ(line, told) << key;
        }
    } else if (line.is_number_integer()) {
        EXPECT_EQ(line, told) << key;
    } else {
        EXPECT_NEAR(line.get<double>(), told.get<double>(), rounding_of(key, line.get<double>()))
            << key;
    }
}

/// Expects that the message `told` contains all fields of `line` with the same values, except the
/// fields for which `is_only_in_lines` returns true. The message must not contain any other fields,
/// except times and the frame number.
inline void expect_told(const nlohmann::json& line, nlohmann::json told) {
    for (const auto& [key, value] : line.items()) {
        if (is_only_in_lines(key)) continue;
        ASSERT_TRUE(told.contains(key)) << key << " of " << line.dump() << "\n" << told.dump();
        expect_value_of(key, value, told[key]);
        told.erase(key);
    }
    for (const char* time : {"timestamp", "stream-time", "running-time", "duration", "frame"})
        told.erase(time);
    EXPECT_EQ(told, nlohmann::json::object());
}

}  // namespace dotpose::test
