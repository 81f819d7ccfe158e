/// Stores the states of all robots in a database.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "command_line.hpp"
#include "state_message.hpp"
#include "store/queue.hpp"

namespace dotpose::cli {

struct StoreArguments {
    std::string where;  ///< PostgreSQL URL or path of an SQLite file, or empty to store nothing
    std::int64_t max_states = 1'000'000;
    int keep_days = 0;  ///< number of days to keep states, or 0 to keep all

    /// Adds --store, --store-buffer and --store-days.
    void add_to(Command& command);
};

/// Returns the name of a robot, map or sheet as it is stored. The stored name contains only
/// printable characters, so any program can safely display it.
std::string stored_name(std::string_view name);

/// Converts received states to the database format. States with the same names share one copy of
/// the names.
class StoredStates {
  public:
    /// Converts a state. The time of the result is the robot's time stamp. If the time stamp
    /// differs from the arrival time by more than half an hour, the arrival time is used instead.
    store::State of(std::string_view robot, const RobotState& state, std::int64_t received_us);

  private:
    /// Maximum number of cached names. Limits the memory use, because any client of the broker can
    /// send states with arbitrary names.
    static constexpr std::size_t kMaxNames = 20'000;

    std::map<std::string, std::shared_ptr<const std::string>, std::less<>> robots_;
    std::map<store::Place, std::shared_ptr<const store::Place>> places_;
};

class FleetStore {
  public:
    /// Throws Error if a database file cannot be opened, or if the library for the database is
    /// missing. `notify` receives messages for the user and may be called on another thread.
    FleetStore(const StoreArguments& arguments, std::function<void(const std::string&)> notify);

    void add(std::string_view robot, const RobotState& state, std::int64_t received_us) {
        queue_.push(states_.of(robot, state, received_us));
    }
    store::QueueStatus status() const { return queue_.status(); }

    /// Waits up to 10 s for the queued states to be stored. Reports how many states were stored and
    /// how many were dropped. Throws Error if some states were not stored, for example because the
    /// database was unavailable.
    void finish();

  private:
    std::function<void(const std::string&)> notify_;
    StoredStates states_;
    store::Queue queue_;
};

}  // namespace dotpose::cli
