#include "fleet_store.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

/// Returns `value` * `factor`, rounded to an integer and clamped to the range of a 32-bit integer.
std::int32_t narrow(double value, double factor) {
    constexpr double kMax = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::lround(std::clamp(value * factor, -kMax, kMax)));
}

store::Motion motion_of(const RobotState& state) {
    if (!state.is_localized) return store::Motion::lost;
    return state.state == "stationary" ? store::Motion::still : store::Motion::moving;
}

Status status_of(const std::string& reason) {
    if (reason.empty()) return Status::ok;
    for (int i = 0; i < kStatusCount; ++i) {
        if (name(static_cast<Status>(i)) == reason) return static_cast<Status>(i);
    }
    return Status::other;
}

}  // namespace

void StoreArguments::add_to(Command& command) {
    command
        .add_option("--store", where,
                    "Write every state to a database: postgresql://USER@HOST/DATABASE, or a file "
                    "(SQLite)")
        ->type_name("WHERE");
    command
        .add_option("--store-buffer", max_states,
                    "Maximum number of states that wait while the database is away")
        ->type_name("N")
        ->capture_default_str()
        ->check(Range(1, 1'000'000'000));
    command
        .add_option("--store-days", keep_days, "Keep this number of days, and remove older states")
        ->type_name("N")
        ->default_str("all")
        ->check(Range(1, 36'500));
}

std::string stored_name(std::string_view name) {
    return printable(name);
}

store::State StoredStates::of(std::string_view robot, const RobotState& state,
                              std::int64_t received_us) {
    constexpr std::int64_t kMaxDelay_us = 1'800'000'000;  // half an hour (fits in 32 bits)
    store::State stored;
    if (robots_.size() > kMaxNames) robots_.clear();
    if (places_.size() > kMaxNames) places_.clear();
    auto known = robots_.find(robot);
    if (known == robots_.end()) {
        known = robots_.emplace(robot, std::make_shared<std::string>(stored_name(robot))).first;
    }
    stored.robot = known->second;
    auto& place = places_[{state.map_id, state.sheet}];
    if (!place) {
        place = std::make_shared<store::Place>(
            store::Place{stored_name(state.map_id), stored_name(state.sheet)});
    }
    stored.place = place;
    const std::int64_t delay_us = received_us - state.sent_us;
    const bool is_plausible = std::abs(delay_us) <= kMaxDelay_us;
    stored.time_us = is_plausible ? state.sent_us : received_us;
    stored.delay_us = is_plausible ? static_cast<std::int32_t>(delay_us) : 0;
    stored.number =
        static_cast<std::int64_t>(state.header_id & std::numeric_limits<std::int64_t>::max());
    stored.motion = motion_of(state);
    stored.reason = status_of(state.reason);
    stored.x_nm = std::llround(state.x_m * 1e9);
    stored.y_nm = std::llround(state.y_m * 1e9);
    stored.theta_urad = narrow(std::remainder(state.theta_rad, 2 * std::numbers::pi), 1e6);
    stored.deviation_nm = narrow(state.deviation_m, 1e9);
    stored.vx_um_s = narrow(state.vx_m_s, 1e6);
    stored.vy_um_s = narrow(state.vy_m_s, 1e6);
    stored.omega_urad_s = narrow(state.omega_rad_s, 1e6);
    return stored;
}

FleetStore::FleetStore(const StoreArguments& arguments,
                       std::function<void(const std::string&)> notify)
    : notify_(std::move(notify)),
      queue_(store::make_database(arguments.where, store::Access::write),
             store::is_on_server(arguments.where),
             {.max_states = static_cast<std::size_t>(arguments.max_states),
              .keep_days = arguments.keep_days,
              .notify = notify_}) {}

void FleetStore::finish() {
    constexpr auto kPatience = std::chrono::seconds(10);
    const bool is_complete = queue_.finish(kPatience);
    const store::QueueStatus status = queue_.status();
    notify_(fmt::format("{} states stored, {} dropped", status.stored,
                        status.dropped + status.waiting));
    if (!is_complete || status.dropped > 0) {
        throw Error(fmt::format("{} states were not stored, because the database was away",
                                status.dropped + status.waiting));
    }
}

}  // namespace dotpose::cli
