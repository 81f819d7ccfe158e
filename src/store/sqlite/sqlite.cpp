// Stores states in a SQLite file. The table is sorted by robot and time, so the states of a robot
// are adjacent.
#include <memory>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <sqlite3.h>

#include "store/database.hpp"
#include "store/ids.hpp"
#include "store/schema.hpp"

namespace dotpose::store {
namespace {

constexpr Dialect kSqliteDialect = {
    "INTEGER PRIMARY KEY", "WITHOUT ROWID", "CREATE VIEW IF NOT EXISTS",
    "strftime('%Y-%m-%dT%H:%M:%f', states.time_us / 1e6, 'unixepoch') || 'Z'"};

struct Closer {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

class Connection {
  public:
    Connection(const std::string& path, Access access) : path_(path) {
        constexpr int kBusy_ms = 5000;
        sqlite3* database = nullptr;
        // Readers also need write access, because they update the shared memory of the write-ahead
        // log.
        const int flags =
            SQLITE_OPEN_READWRITE | (access == Access::write ? SQLITE_OPEN_CREATE : 0);
        const int code = sqlite3_open_v2(path.c_str(), &database, flags, nullptr);
        database_.reset(database);
        require(code);
        sqlite3_busy_timeout(database, kBusy_ms);
    }

    void run(const std::string& statements) {
        require(sqlite3_exec(database_.get(), statements.c_str(), nullptr, nullptr, nullptr));
    }
    void require(int code) const {
        if (code == SQLITE_OK || code == SQLITE_ROW || code == SQLITE_DONE) return;
        throw Error(
            fmt::format("cannot use the database {}: {}", path_, sqlite3_errmsg(database_.get())));
    }
    sqlite3* get() const { return database_.get(); }

  private:
    std::string path_;
    std::unique_ptr<sqlite3, Closer> database_;
};

class Statement {
  public:
    Statement(const Connection& connection, std::string_view text) : connection_(connection) {
        sqlite3_stmt* statement = nullptr;
        connection.require(sqlite3_prepare_v2(connection.get(), text.data(),
                                              static_cast<int>(text.size()), &statement, nullptr));
        statement_.reset(statement);
    }

    /// Binds the next parameter. Strings must remain valid until the statement has run.
    Statement& bind(std::int64_t value) {
        connection_.require(sqlite3_bind_int64(statement_.get(), ++bound_, value));
        return *this;
    }
    Statement& bind(std::optional<std::int64_t> value) {
        if (value) return bind(*value);
        connection_.require(sqlite3_bind_null(statement_.get(), ++bound_));
        return *this;
    }
    Statement& bind(std::string_view text) {
        connection_.require(sqlite3_bind_text(statement_.get(), ++bound_, text.data(),
                                              static_cast<int>(text.size()), SQLITE_STATIC));
        return *this;
    }
    bool step() {
        const int code = sqlite3_step(statement_.get());
        connection_.require(code);
        return code == SQLITE_ROW;
    }
    /// Runs the statement. Afterwards, new parameters can be bound.
    void run() {
        while (step()) {
        }
        sqlite3_reset(statement_.get());
        bound_ = 0;
    }
    std::optional<std::int64_t> integer(int column) const {
        if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
        return sqlite3_column_int64(statement_.get(), column);
    }
    std::string_view text(int column) const {
        const auto* bytes =
            reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
        const int size = sqlite3_column_bytes(statement_.get(), column);
        return bytes == nullptr ? std::string_view()
                                : std::string_view(bytes, static_cast<std::size_t>(size));
    }

  private:
    const Connection& connection_;
    std::unique_ptr<sqlite3_stmt, Closer> statement_;
    int bound_ = 0;
};

class Sqlite : public Database {
  public:
    Sqlite(std::string path, Access access) : path_(std::move(path)), access_(access) {}

    std::string label() const override { return path_; }

    void prepare() override {
        if (connection_) return;
        Connection connection(path_, access_);
        if (access_ == Access::write) {
            // With the write-ahead log, readers need not wait for the writer. With full
            // synchronization, completed transactions survive a power failure.
            connection.run(
                "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA cache_size = -65536;"
                "BEGIN IMMEDIATE;" +
                schema_of(kSqliteDialect) + "COMMIT;");
        }
        Statement version(connection, "SELECT max(version) FROM version");
        version.step();
        if (version.integer(0) != kVersion) {
            throw Error(
                fmt::format("{} was written by another version of dotpose: its tables have "
                            "version {} instead of {}",
                            path_, version.integer(0).value_or(0), kVersion));
        }
        connection_.emplace(std::move(connection));
    }

    void write(std::span<const State> states) override {
        run([&](const Connection& connection) {
            connection_->run("BEGIN IMMEDIATE");
            Statement insert(connection, fmt::format("INSERT OR IGNORE INTO states ({}) VALUES "
                                                     "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                                                     kColumns));
            for (const State& state : states) {
                const std::int64_t robot = robot_id(*state.robot);
                const std::int64_t place = place_id(*state.place);
                for (const auto& value : integers_of(state, robot, place))
                    insert.bind(value);
                insert.bind(name(state.motion)).bind(reason_text(state.reason));
                insert.run();
            }
            connection_->run("COMMIT");
        });
    }

    void remove_days_before(std::int64_t time_us) override {
        run([&](const Connection& connection) {
            // Removes the states of each robot in a separate transaction, so that other programs
            // can write between the transactions.
            std::vector<std::int64_t> ids;
            Statement select(connection, "SELECT robot FROM robots");
            while (select.step())
                ids.push_back(*select.integer(0));
            Statement remove(connection, "DELETE FROM states WHERE robot = ? AND time_us < ?");
            for (const std::int64_t id : ids)
                remove.bind(id).bind(time_us - time_us % kDay_us).run();
        });
    }

    void read(const Query& query, const std::function<void(const State&)>& take) override {
        run([&](const Connection& connection) {
            // Reads the places and the states in one transaction. Otherwise, a state could refer to
            // a place that was added after the places were read.
            connection_->run("BEGIN");
            const auto robot = std::make_shared<const std::string>(query.robot);
            const auto places = all_places(connection);
            Statement select(
                connection,
                fmt::format("SELECT {} FROM states WHERE robot = (SELECT robot FROM robots WHERE "
                            "name = ?) AND time_us >= ? AND time_us < ? ORDER BY time_us, number",
                            kColumns));
            select.bind(std::string_view(*robot)).bind(query.from_us).bind(query.to_us);
            while (select.step()) {
                Integers integers;
                for (int i = 0; i < kIntegerCount; ++i)
                    integers[static_cast<std::size_t>(i)] = select.integer(i);
                State state =
                    state_of(integers, select.text(kIntegerCount), select.text(kIntegerCount + 1));
                state.robot = robot;
                state.place = places.at(*integers[5]);
                take(state);
            }
            connection_->run("COMMIT");
        });
    }

    std::vector<RobotSpan> robots() override {
        std::vector<RobotSpan> spans;
        run([&](const Connection& connection) {
            Statement select(connection,
                             "SELECT name, (SELECT min(time_us) FROM states WHERE "
                             "states.robot = robots.robot), (SELECT max(time_us) FROM states WHERE "
                             "states.robot = robots.robot) FROM robots ORDER BY name");
            while (select.step()) {
                if (!select.integer(1)) continue;
                spans.push_back(
                    {std::string(select.text(0)), *select.integer(1), *select.integer(2)});
            }
        });
        return spans;
    }

  private:
    /// Calls `work(connection)`. After an exception, closes the file, which rolls back the
    /// transaction.
    template <typename Work>
    void run(const Work& work) {
        try {
            prepare();
            work(*connection_);
        } catch (...) {
            robots_.clear();
            places_.clear();
            connection_.reset();
            throw;
        }
    }

    static std::map<std::int64_t, std::shared_ptr<const Place>> all_places(
        const Connection& connection) {
        std::map<std::int64_t, std::shared_ptr<const Place>> places;
        Statement select(connection, "SELECT place, map, sheet FROM places");
        while (select.step()) {
            places[*select.integer(0)] = std::make_shared<const Place>(
                Place{std::string(select.text(1)), std::string(select.text(2))});
        }
        return places;
    }

    std::int64_t robot_id(const std::string& robot) {
        return robots_.of(robot, [this](std::string_view name) {
            Statement(*connection_, "INSERT OR IGNORE INTO robots (name) VALUES (?)")
                .bind(name)
                .run();
            Statement select(*connection_, "SELECT robot FROM robots WHERE name = ?");
            select.bind(name).step();
            return *select.integer(0);
        });
    }

    std::int64_t place_id(const Place& place) {
        return places_.of(place, [this](const Place& key) {
            Statement(*connection_, "INSERT OR IGNORE INTO places (map, sheet) VALUES (?, ?)")
                .bind(std::string_view(key.map))
                .bind(std::string_view(key.sheet))
                .run();
            Statement select(*connection_, "SELECT place FROM places WHERE map = ? AND sheet = ?");
            select.bind(std::string_view(key.map)).bind(std::string_view(key.sheet)).step();
            return *select.integer(0);
        });
    }

    std::string path_;
    Access access_;
    std::optional<Connection> connection_;
    Ids<std::string> robots_;
    Ids<Place> places_;
};

}  // namespace

std::unique_ptr<Database> make_sqlite(const std::string& path, Access access) {
    return std::make_unique<Sqlite>(path, access);
}

}  // namespace dotpose::store
