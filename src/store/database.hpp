// Databases of robot states: SQLite files and PostgreSQL servers. Both have the same tables
// (schema.hpp). docs/fleet.md describes the tables.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dotpose/files/error.hpp"
#include "dotpose/status.hpp"

namespace dotpose::store {

enum class Motion : std::uint8_t { moving, still, lost };

/// Returns "moving", "still" or "lost".
std::string_view name(Motion motion);

struct Place {
    std::string map;
    std::string sheet;  ///< empty if unknown
    auto operator<=>(const Place&) const = default;
};

/// A state of a robot. Strings must be valid UTF-8 without null characters. `robot` is the name of
/// the robot. Many states can share the objects that `robot` and `place` point to.
struct State {
    std::shared_ptr<const std::string> robot;
    std::shared_ptr<const Place> place;
    /// Time at which the robot sent the state, in microseconds since 1970. It determines the day to
    /// which the state belongs.
    std::int64_t time_us = 0;
    std::int64_t number = 0;       ///< sequence number
    std::int32_t delay_us = 0;     ///< time from sending to receiving
    Motion motion = Motion::lost;  ///< if `lost`, only the members up to `reason` are stored
    /// Reason why the robot is lost, or `ok` if it is not lost or the reason is unknown.
    Status reason = Status::ok;
    std::int32_t theta_urad = 0;
    std::int64_t x_nm = 0;
    std::int64_t y_nm = 0;
    std::int32_t deviation_nm = 0;
    std::int32_t vx_um_s = 0;
    std::int32_t vy_um_s = 0;
    std::int32_t omega_urad_s = 0;
};

/// Selects the states of a robot in a time span. The span does not include its end.
struct Query {
    std::string robot;
    std::int64_t from_us = std::numeric_limits<std::int64_t>::min();
    std::int64_t to_us = std::numeric_limits<std::int64_t>::max();  ///< end of the time span
};

struct RobotSpan {
    std::string robot;
    std::int64_t first_us = 0;
    std::int64_t last_us = 0;
};

/// Access mode for a database. With `read`, missing databases and tables are not created.
enum class Access { read, write };

/// A connection to a database. It is opened by the first call that needs it, and reopened by the
/// next call after an Error. Not thread-safe.
class Database {
  public:
    Database() = default;
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;
    virtual ~Database() = default;

    /// Returns the name of the database for messages, without a password.
    virtual std::string label() const = 0;

    /// Opens the database, and creates missing tables. Throws Error if this fails.
    virtual void prepare() = 0;

    /// Writes all states in one transaction. Skips states that are already stored. Throws Error if
    /// the transaction fails. After an Error, either all states or none are stored, so the call can
    /// safely be repeated.
    virtual void write(std::span<const State> states) = 0;

    /// Removes the states of all days before the day that contains `time_us`. Throws Error if this
    /// fails.
    virtual void remove_days_before(std::int64_t time_us) = 0;

    /// Calls `take` with each state that the query selects, in chronological order. An exception
    /// thrown by `take` stops the read and is propagated. Throws Error if reading fails.
    virtual void read(const Query& query, const std::function<void(const State&)>& take) = 0;

    /// Returns all robots that have states, sorted by name, with the times of their first and last
    /// states. Throws Error if this fails.
    virtual std::vector<RobotSpan> robots() = 0;
};

/// Returns true if `where` is a URL of a database server (postgresql:// or postgres://).
bool is_on_server(const std::string& where);

/// Creates the object for a PostgreSQL URL or a SQLite file without opening the database. Throws
/// Error if dotpose was built without the required library.
std::unique_ptr<Database> make_database(const std::string& where, Access access);

std::unique_ptr<Database> make_sqlite(const std::string& path, Access access);
std::unique_ptr<Database> make_postgres(const std::string& url, Access access);

}  // namespace dotpose::store
