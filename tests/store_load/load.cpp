// Writes the states of many robots over a day to a database, as `dotpose fleet --store` does but
// faster than real time. Then reads all states, checks that none is missing, and prints rates and
// times. docs/fleet.md contains the results.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "../../apps/dotpose/command_line.hpp"
#include "store/database.hpp"

namespace dotpose::test {
namespace {

using store::State;

constexpr std::int64_t kBegin_us = 1'794'960'000'000'000;  // 2026-11-18, midnight
constexpr std::int64_t kSecond_us = 1'000'000;

struct Arguments {
    std::string where;
    int robots = 200;
    int hz = 10;
    int hours = 24;
    int period_s = 5;  ///< time span of the states in one transaction
    bool only_reads = false;
};

double seconds_of(const std::function<void()>& work) {
    const auto begun = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

std::string name_of(int robot) {
    return fmt::format("robot{}", robot);
}

class Robots {
  public:
    explicit Robots(int count) {
        for (int i = 0; i < count; ++i)
            names_.push_back(std::make_shared<const std::string>(name_of(i)));
    }
    State state(int robot, std::int64_t number, int hz) const {
        const double angle = std::remainder(0.1 * static_cast<double>(number) / hz, 6.283185307);
        State state;
        state.robot = names_[static_cast<std::size_t>(robot)];
        state.place = place_;
        state.time_us = kBegin_us + number * kSecond_us / hz + robot;
        state.number = number;
        state.delay_us = 800 + static_cast<std::int32_t>(number * 7919 % 1000);
        state.motion = store::Motion::moving;
        state.x_nm = robot * 500'000'000LL + std::llround(2e8 * std::cos(angle));
        state.y_nm = std::llround(2e8 * std::sin(angle));
        state.theta_urad = static_cast<std::int32_t>(angle * 1e6);
        state.deviation_nm = 350;
        state.vx_um_s = static_cast<std::int32_t>(-20'000 * std::sin(angle));
        state.vy_um_s = static_cast<std::int32_t>(20'000 * std::cos(angle));
        state.omega_urad_s = 100'000;
        return state;
    }

  private:
    std::vector<std::shared_ptr<const std::string>> names_;
    std::shared_ptr<const store::Place> place_ =
        std::make_shared<const store::Place>(store::Place{"hall", "left"});
};

void write_all(const Arguments& arguments) {
    const auto database = store::make_database(arguments.where, store::Access::write);
    const Robots robots(arguments.robots);
    const std::int64_t seconds = std::int64_t{arguments.hours} * 3600;
    std::int64_t written = 0;
    const double elapsed_s = seconds_of([&] {
        std::vector<State> batch;
        for (std::int64_t second = 0; second < seconds; second += arguments.period_s) {
            batch.clear();
            // The states are sorted by robot and time, as in the queue.
            for (int robot = 0; robot < arguments.robots; ++robot) {
                for (int i = 0; i < arguments.period_s * arguments.hz; ++i)
                    batch.push_back(robots.state(robot, second * arguments.hz + i, arguments.hz));
            }
            database->write(batch);
            written += static_cast<std::int64_t>(batch.size());
        }
    });
    fmt::print("{} states written in {:.0f} s: {:.0f} states/s\n", written, elapsed_s,
               static_cast<double>(written) / elapsed_s);
    std::fflush(stdout);
}

/// Reads the states that a robot sent in a time interval. Returns the number of states, or -1 if
/// the message numbers are not consecutive.
std::int64_t count_states(store::Database& database, int robot, std::int64_t from_s,
                          std::int64_t to_s, int hz) {
    std::int64_t count = 0;
    bool is_complete = true;
    database.read({name_of(robot), kBegin_us + from_s * kSecond_us, kBegin_us + to_s * kSecond_us},
                  [&](const State& state) {
                      is_complete = is_complete && state.number == from_s * hz + count;
                      ++count;
                  });
    return is_complete ? count : -1;
}

void measure_queries(store::Database& database, const Arguments& arguments) {
    const std::int64_t end_s = std::int64_t{arguments.hours} * 3600;
    for (const std::int64_t length_s : {std::int64_t{60}, std::int64_t{3600}, end_s}) {
        const std::int64_t from_s = (end_s - length_s) / 2;
        for (const int robot : {arguments.robots / 3, arguments.robots / 2}) {
            std::int64_t count = 0;
            const double elapsed_s = seconds_of([&] {
                count = count_states(database, robot, from_s, from_s + length_s, arguments.hz);
            });
            fmt::print("{} s of one robot: {} states in {:.3f} s\n", length_s, count, elapsed_s);
        }
    }
    const double elapsed_s = seconds_of([&] { database.robots(); });
    fmt::print("list of robots: {:.3f} s\n", elapsed_s);
    std::fflush(stdout);
}

/// Returns true if every state of every robot is stored exactly once.
bool check_all(store::Database& database, const Arguments& arguments) {
    const std::int64_t end_s = std::int64_t{arguments.hours} * 3600;
    std::int64_t total = 0;
    bool is_complete = true;
    const double elapsed_s = seconds_of([&] {
        for (int robot = 0; robot < arguments.robots; ++robot) {
            const std::int64_t count = count_states(database, robot, 0, end_s, arguments.hz);
            is_complete = is_complete && count == end_s * arguments.hz;
            total += count;
        }
    });
    fmt::print("{} states read in {:.0f} s: {}\n", total, elapsed_s,
               is_complete ? "complete" : "INCOMPLETE");
    return is_complete;
}

int run(const Arguments& arguments) {
    if (!arguments.only_reads) write_all(arguments);
    const auto database = store::make_database(arguments.where, store::Access::read);
    measure_queries(*database, arguments);
    return check_all(*database, arguments) ? 0 : 1;
}

}  // namespace
}  // namespace dotpose::test

int main(int argc, char** argv) {
    using dotpose::cli::Range;
    dotpose::test::Arguments arguments;
    dotpose::cli::Command command("Writes a day of states to a database, and reads it");
    command.add_option("--store", arguments.where, "Database, as for dotpose fleet")->required();
    command.add_option("--robots", arguments.robots, "Number of robots")->check(Range(1, 10'000));
    command.add_option("--hz", arguments.hz, "States per second of each robot")
        ->check(Range(1, 1000));
    command.add_option("--hours", arguments.hours, "Time span")->check(Range(1, 24));
    command.add_option("--period", arguments.period_s, "Seconds of a transaction")
        ->check(Range(1, 60));
    command.add_flag("--only-reads", arguments.only_reads, "Read an earlier run");
    try {
        return command.parse(argc, argv) ? dotpose::test::run(arguments) : 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_store_load: {}\n", error.what());
        return 2;
    }
}
