/// Receives the messages of a fleet from the MQTT broker.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "fleet_log.hpp"
#include "fleet_share.hpp"
#include "fleet_state.hpp"
#include "fleet_store.hpp"
#include "publish/mqtt.hpp"

namespace dotpose::cli {

/// Clock that returns the current time as a Now. Only one thread may call `observe`. Any thread may
/// call `now`.
class WatchedClock {
  public:
    WatchedClock();

    /// Must be called regularly with the current connection state. While there is no connection to
    /// the broker, Now::watched_us does not advance.
    void observe(bool is_connected);

    Now now() const;

  private:
    std::int64_t observed_us_;
    std::atomic<std::int64_t> blind_us_ = 0;  ///< total time without a connection to the broker
};

struct FleetInputOptions {
    publish::MqttOptions mqtt;
    ShareArguments share;
    ConditionLimits limits;
    std::string log;  ///< path of a CSV file for all states, or empty to write no file
};

/// Maintains the state of the fleet. The subscriber calls `take` on its own thread.
class FleetInput {
  public:
    /// If `store` is null, the states are not stored. Otherwise, `store` must outlive this object.
    /// Throws Error if the broker rejects the connection or the log cannot be created.
    FleetInput(const FleetInputOptions& options, FleetStore* store);

    const FleetState& fleet() const { return fleet_; }
    Now now() const { return clock_.now(); }

    /// Must be called regularly (see WatchedClock::observe).
    void observe() { clock_.observe(is_connected()); }

    bool is_connected() const { return subscriber_->is_connected(); }

    /// Writes the buffered log lines. Throws Error on failure.
    void flush();

    /// Disconnects and finishes the log. Throws Error if the log cannot be written.
    void finish();

    /// Throws Error if a connection to the broker has never been established.
    void require_reached() const { subscriber_->require_reached(); }

  private:
    void take(std::string_view topic, std::string_view payload);
    void record(std::string_view robot, const RobotState& state);

    Shard shard_;
    WatchedClock clock_;
    std::int64_t received_us_ = 0;  ///< arrival time of the current message on the system clock
    std::optional<FleetLog> log_;
    FleetStore* store_;
    FleetState fleet_;
    std::optional<publish::MqttSubscriber> subscriber_;
};

}  // namespace dotpose::cli
