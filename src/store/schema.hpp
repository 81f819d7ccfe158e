// The tables that all databases contain, and the conversion between rows and states.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "store/database.hpp"

namespace dotpose::store {

inline constexpr std::int64_t kDay_us = 86'400'000'000;

/// Version of the tables, stored in the `version` table.
inline constexpr int kVersion = 1;

/// Parts of the SQL statements that differ between databases.
struct Dialect {
    std::string_view generated_key;  ///< definition of an integer primary key with generated values
    std::string_view partition;      ///< last clause of the statement that creates `states`
    std::string_view create_view;    ///< start of the statement that creates the view
    std::string_view time;           ///< SQL expression that converts `time_us` to a time
};

/// Returns statements that create the missing tables and the view, separated by semicolons.
std::string schema_of(const Dialect& dialect);

/// Columns of the `states` table, in the order of its definition.
inline constexpr std::string_view kColumns =
    "time_us, number, x_nm, y_nm, robot, place, delay_us, theta_urad, deviation_nm, vx_um_s, "
    "vy_um_s, omega_urad_s, state, reason";
inline constexpr int kColumnCount = 14;
/// Number of integer columns. The columns after them contain text.
inline constexpr int kIntegerCount = 12;
/// Number of 64-bit integer columns. The 32-bit integer columns follow them.
inline constexpr int kWideCount = 4;

/// Values of the integer columns. nullopt represents null.
using Integers = std::array<std::optional<std::int64_t>, kIntegerCount>;

Integers integers_of(const State& state, std::int64_t robot_id, std::int64_t place_id);

/// Returns the text of the `reason` column.
std::string_view reason_text(Status reason);

/// Returns the state stored in a row, without `robot` and `place`.
State state_of(const Integers& integers, std::string_view state, std::string_view reason);

/// Returns the name of the partition for a day, such as "states_20261128". `day` is the number of
/// days since 1970-01-01.
std::string partition_name(std::int64_t day);

}  // namespace dotpose::store
