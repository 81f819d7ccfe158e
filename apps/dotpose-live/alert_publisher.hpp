/// Publishes alerts about the robots of a fleet through the MQTT broker.
#pragma once

#include <cstdint>

#include "fleet_alerts.hpp"
#include "publish/mqtt.hpp"

namespace dotpose::cli {

class AlertPublisher {
  public:
    /// Throws Error if the broker rejects the connection.
    explicit AlertPublisher(publish::MqttOptions options);

    /// Publishes an alert for each important change since the previous call (fleet_alerts.hpp).
    void check(const FleetRobots& robots, const Now& now);

    /// Waits up to 2 s for all alerts to be sent, and reports how many alerts were published and
    /// how many were dropped.
    void finish();

  private:
    AlertWatch watch_;
    std::uint64_t messages_ = 0;
    publish::MqttPublisher publisher_;
};

}  // namespace dotpose::cli
