// Databases of the states of robots: SQLite files, and PostgreSQL servers. Both have the same
// tables (schema.hpp). docs/fleet.md describes them.
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

/// A state of a robot. Texts must be valid UTF-8 without null characters. Few robots and places
/// have many states, so states share their names.
struct State {
    std::shared_ptr<const std::string> robot;
    std::shared_ptr<const Place> place;
    /// Microseconds since 1970 at which the robot sent the state. Determines the day.
    std::int64_t time_us = 0;
    std::int64_t number = 0;       ///< sequence number
    std::int32_t delay_us = 0;     ///< from sending to receiving
    Motion motion = Motion::lost;  ///< if lost, the members after `reason` are not stored
    Status reason = Status::ok;    ///< why the robot is lost; ok if it is not lost, or unknown
    std::int32_t theta_urad = 0;
    std::int64_t x_nm = 0;
    std::int64_t y_nm = 0;
    std::int32_t deviation_nm = 0;
    std::int32_t vx_um_s = 0;
    std::int32_t vy_um_s = 0;
    std::int32_t omega_urad_s = 0;
};

/// Selects the states of a robot in a time span.
struct Query {
    std::string robot;
    std::int64_t from_us = std::numeric_limits<std::int64_t>::min();
    std::int64_t to_us = std::numeric_limits<std::int64_t>::max();  ///< excluded
};

/// Times of the first and the last state of a robot.
struct RobotSpan {
    std::string robot;
    std::int64_t first_us = 0;
    std::int64_t last_us = 0;
};

/// Readers create neither a database nor tables.
enum class Access { read, write };

/// A connection to a database, which is opened when it is needed. After an Error, the next call
/// opens it again. Not thread-safe.
class Database {
  public:
    Database() = default;
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;
    virtual ~Database() = default;

    /// Returns the database without its password, for messages.
    virtual std::string label() const = 0;

    /// Opens the database, and creates the tables if they are missing. Throws Error.
    virtual void prepare() = 0;

    /// Writes all states in one transaction. States that are already stored are skipped. Throws
    /// Error. In this case, either all states or none are stored, and the call may be repeated.
    virtual void write(std::span<const State> states) = 0;

    /// Removes the states of all days before the day of `time_us`. Throws Error.
    virtual void remove_days_before(std::int64_t time_us) = 0;

    /// Calls `take` with the selected states in the order of their times. Throws Error.
    virtual void read(const Query& query, const std::function<void(const State&)>& take) = 0;

    /// Returns all robots in the order of their names. Throws Error.
    virtual std::vector<RobotSpan> robots() = 0;
};

/// Returns true if the database is on a server, which may be away: postgresql:// or postgres://.
bool is_on_server(const std::string& where);

/// Returns the database at a URL of PostgreSQL, or in a file of SQLite. Does not open it. Throws
/// Error if this program was built without the library.
std::unique_ptr<Database> make_database(const std::string& where, Access access);

std::unique_ptr<Database> make_sqlite(const std::string& path, Access access);
std::unique_ptr<Database> make_postgres(const std::string& url, Access access);

}  // namespace dotpose::store
