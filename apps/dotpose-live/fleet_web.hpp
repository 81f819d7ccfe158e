/// Serves the web page and the metrics of `dotpose fleet --web` and `dotpose listen --web`.
/// docs/fleet.md describes the topics.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "fleet_alerts.hpp"
#include "fleet_values.hpp"
#include "serve/server.hpp"
#include "web_history.hpp"

namespace dotpose::cli {

struct FleetWebOptions {
    serve::ServerOptions server;
    ConditionLimits limits = {};
    std::string store = {};   ///< database from which the page reads states, or empty
    std::string device = {};  ///< name of the robot for `dotpose listen`, or empty for a fleet
    // The following functions may be called from any thread.
    std::function<Now()> now;
    std::function<FleetServices()> services;
    /// Removes a robot from the broker. Null if the page must not remove robots.
    std::function<void(const std::string& robot)> remove = nullptr;
};

/// Serves the page. Uses separate threads, so the caller is not blocked.
class FleetWeb {
  public:
    /// Starts the server and reports its address. `fleet` and `map` must outlive this object.
    /// Throws BadArgument or Error on failure.
    FleetWeb(FleetWebOptions options, const FleetState& fleet, const FleetMap& map);
    ~FleetWeb();
    FleetWeb(const FleetWeb&) = delete;
    FleetWeb& operator=(const FleetWeb&) = delete;

  private:
    using Clock = std::chrono::steady_clock;
    using Snapshot = std::shared_ptr<const FleetSnapshot>;
    /// A topic that is published at most once per period.
    struct TimedTopic {
        serve::Topic& topic;
        std::chrono::milliseconds period;
        Clock::time_point next{};
    };

    void run();
    /// Returns true if the topic's period has passed and a client is ready for a new value. If so,
    /// starts the next period.
    static bool is_due(TimedTopic& timed, Clock::time_point now);
    /// Returns the current robots. All topics published in the same tick use the same snapshot.
    const Snapshot& snapshot();
    void note_alerts(Clock::time_point now);
    void publish_lists(Clock::time_point now);
    void publish_map(Clock::time_point now);
    void obey();
    void remove(const serve::Command& command);

    FleetWebOptions options_;
    const FleetState& fleet_;
    const FleetMap& map_;
    AlertWatch watch_;
    std::deque<RobotAlert> alerts_;
    Clock::time_point next_check_;
    Snapshot snapshot_;  ///< robots in the current tick, or null if not needed yet
    std::int64_t counted_states_ = 0;
    Clock::time_point counted_at_;

    serve::Server server_;
    serve::Topic& setup_;
    TimedTopic summary_;
    TimedTopic table_;
    TimedTopic robot_;
    TimedTopic positions_;
    TimedTopic trails_;
    serve::Topic& history_topic_;
    std::optional<WebHistory> history_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

}  // namespace dotpose::cli
