/// Writes the states of all robots to a database.
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
    std::string where;  ///< URL of PostgreSQL, or file of SQLite; none if empty
    std::int64_t max_states = 1'000'000;
    int keep_days = 0;  ///< 0: all

    /// Adds --store, --store-buffer and --store-days.
    void add_to(Command& command);
};

/// Returns the name of a robot, map or sheet in the form in which it is stored: with printable
/// characters only, so that every program can show it.
std::string stored_name(std::string_view name);

/// Converts received states to stored states. Equal names share memory.
class StoredStates {
  public:
    /// Converts a state. The time of the stored state is the time stamp of the robot or, if this
    /// differs by more than half an hour from the time of arrival, the time of arrival.
    store::State of(std::string_view robot, const RobotState& state, std::int64_t received_us);

  private:
    /// Maximum number of remembered names. Limits the memory, because any client of the broker can
    /// send states with arbitrary names.
    static constexpr std::size_t kMaxNames = 20'000;

    std::map<std::string, std::shared_ptr<const std::string>, std::less<>> robots_;
    std::map<store::Place, std::shared_ptr<const store::Place>> places_;
};

class FleetStore {
  public:
    /// Throws Error if the database is a file that cannot be opened, or if the library for the
    /// database is missing. `tell` receives messages for the user, possibly in another thread.
    FleetStore(const StoreArguments& arguments, std::function<void(const std::string&)> tell);

    void add(std::string_view robot, const RobotState& state, std::int64_t received_us) {
        queue_.push(states_.of(robot, state, received_us));
    }
    store::QueueStatus status() const { return queue_.status(); }

    /// Stores the states in the queue, and reports their number. Throws Error if states were not
    /// stored, for example because the database was not available for 10 s.
    void finish();

  private:
    std::function<void(const std::string&)> tell_;
    StoredStates states_;
    store::Queue queue_;
};

}  // namespace dotpose::cli
