#include "store/schema.hpp"

#include <chrono>

#include <fmt/core.h>

namespace dotpose::store {
namespace {

constexpr std::array<std::string_view, 3> kMotions = {"moving", "still", "lost"};

}  // namespace

std::string_view name(Motion motion) {
    return kMotions[static_cast<std::size_t>(motion)];
}

std::string schema_of(const Dialect& dialect) {
    return fmt::format(
        "CREATE TABLE IF NOT EXISTS version (version INTEGER NOT NULL);"
        "INSERT INTO version SELECT {version} WHERE NOT EXISTS (SELECT 1 FROM version);"
        "CREATE TABLE IF NOT EXISTS robots (robot {key}, name TEXT NOT NULL UNIQUE);"
        "CREATE TABLE IF NOT EXISTS places (place {key}, map TEXT NOT NULL, sheet TEXT NOT NULL,"
        " UNIQUE (map, sheet));"
        "CREATE TABLE IF NOT EXISTS states ("
        " time_us BIGINT NOT NULL, number BIGINT NOT NULL, x_nm BIGINT, y_nm BIGINT,"
        " robot INTEGER NOT NULL, place INTEGER NOT NULL, delay_us INTEGER NOT NULL,"
        " theta_urad INTEGER, deviation_nm INTEGER, vx_um_s INTEGER, vy_um_s INTEGER,"
        " omega_urad_s INTEGER, state TEXT NOT NULL, reason TEXT NOT NULL,"
        " PRIMARY KEY (robot, time_us, number)) {partition};"
        "{view} history AS SELECT robots.name AS robot, {time} AS time, states.number,"
        " states.state, states.reason, places.map, places.sheet,"
        " states.x_nm / 1e6 AS x_mm, states.y_nm / 1e6 AS y_mm,"
        " states.theta_urad * 57.29577951308232 / 1e6 AS theta_deg,"
        " states.deviation_nm / 1e6 AS deviation_mm,"
        " states.vx_um_s / 1e3 AS vx_mm_s, states.vy_um_s / 1e3 AS vy_mm_s,"
        " states.omega_urad_s * 57.29577951308232 / 1e6 AS turn_deg_s,"
        " states.delay_us / 1e3 AS latency_ms, states.time_us"
        " FROM states JOIN robots ON robots.robot = states.robot"
        " JOIN places ON places.place = states.place;",
        fmt::arg("version", kVersion), fmt::arg("key", dialect.generated_key),
        fmt::arg("partition", dialect.partition), fmt::arg("view", dialect.create_view),
        fmt::arg("time", dialect.time));
}

Integers integers_of(const State& state, std::int64_t robot_id, std::int64_t place_id) {
    Integers values{state.time_us,      state.number,  state.x_nm,     state.y_nm,
                    robot_id,           place_id,      state.delay_us, state.theta_urad,
                    state.deviation_nm, state.vx_um_s, state.vy_um_s,  state.omega_urad_s};
    if (state.motion == Motion::lost) {
        for (const std::size_t i : {2U, 3U, 7U, 8U, 9U, 10U, 11U})
            values[i].reset();
    }
    return values;
}

std::string_view reason_text(Status reason) {
    return reason == Status::ok ? "" : dotpose::name(reason);
}

State state_of(const Integers& integers, std::string_view state, std::string_view reason) {
    const auto narrow = [&integers](std::size_t i) {
        return static_cast<std::int32_t>(integers[i].value_or(0));
    };
    State result;
    result.time_us = integers[0].value_or(0);
    result.number = integers[1].value_or(0);
    result.x_nm = integers[2].value_or(0);
    result.y_nm = integers[3].value_or(0);
    result.delay_us = narrow(6);
    result.theta_urad = narrow(7);
    result.deviation_nm = narrow(8);
    result.vx_um_s = narrow(9);
    result.vy_um_s = narrow(10);
    result.omega_urad_s = narrow(11);
    result.motion = state == kMotions[0]   ? Motion::moving
                    : state == kMotions[1] ? Motion::still
                                           : Motion::lost;
    if (reason.empty()) return result;
    result.reason = Status::other;
    for (int i = 0; i < kStatusCount; ++i) {
        if (dotpose::name(static_cast<Status>(i)) == reason) result.reason = static_cast<Status>(i);
    }
    return result;
}

std::string partition_name(std::int64_t day) {
    using namespace std::chrono;
    const year_month_day date{sys_days(days(day))};
    return fmt::format("states_{:04}{:02}{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

}  // namespace dotpose::store
