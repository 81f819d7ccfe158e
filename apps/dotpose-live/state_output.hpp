/// Publishes the readings of `dotpose watch` and `dotpose listen` through an MQTT broker.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mqtt_arguments.hpp"
#include "publish/mqtt.hpp"
#include "reading_sink.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

/// Counts camera frames for the reports in the state messages.
class CameraCounter {
  public:
    void count(const Reading& reading);

    /// Returns a report if at least one second has passed between the previous report and the
    /// newest frame, and nullopt otherwise.
    std::optional<CameraReport> take_report();

  private:
    CameraReport total_;
    std::int64_t newest_us_ = 0;
    std::int64_t reported_us_ = 0;
    std::uint64_t reported_frames_ = 0;
};

/// Creates the numbered state messages of a robot from its readings.
class StateSource {
  public:
    /// `sheets` is the path of the sheet file. Its file name without extension is the name of the
    /// map in which world poses are given. `max_rate_hz` is the maximum number of states per
    /// second, or 0 for one state per reading. An event always creates a state immediately,
    /// regardless of this maximum.
    StateSource(std::string robot, const std::string& sheets, double max_rate_hz);

    /// Counts a reading. Returns its state, or nullopt if no state is due.
    std::optional<RobotState> next(const Reading& reading);

  private:
    std::string robot_;
    std::string world_map_;
    std::int64_t period_us_;
    std::int64_t next_us_;
    std::uint64_t states_ = 0;
    CameraCounter camera_;
};

/// Publishes the states of the robot through the broker.
class StateOutput : public ReadingSink {
  public:
    /// `sheets` is the path of the sheet file. Throws Error if the broker rejects the connection.
    StateOutput(const PublishArguments& arguments, const std::string& sheets);

    void take(const Reading& reading) override;

    /// Waits up to 2 s for all messages to be sent, and reports the number of sent messages. Throws
    /// Error if no connection to the broker was established.
    void finish() override;

  private:
    StateSource states_;
    publish::MqttPublisher publisher_;
};

}  // namespace dotpose::cli
