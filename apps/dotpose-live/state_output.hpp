/// Publishes the readings of `dotpose watch` and `dotpose listen` through a broker.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mqtt_arguments.hpp"
#include "publish/mqtt.hpp"
#include "reading_sink.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

/// Counts the frames of the camera for the reports that the states contain.
class CameraCounter {
  public:
    void count(const Reading& reading);

    /// Returns a report if the newest frame is at least a second later than the previous report.
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
    /// `sheets` is the path of the sheet file. Its name without extension is the name of the map of
    /// world poses. Creates at most `max_rate_hz` states per second, and additional ones for
    /// events. If `max_rate_hz` is 0, creates a state for each reading.
    StateSource(std::string robot, const std::string& sheets, double max_rate_hz);

    /// Counts the reading. Returns its state, or none if the state is not due.
    std::optional<RobotState> next(const Reading& reading);

  private:
    std::string robot_;
    std::string world_map_;
    std::int64_t period_us_;
    std::int64_t next_us_;
    std::uint64_t states_ = 0;
    CameraCounter camera_;
};

/// Publishes the state of the robot through a broker.
class StateOutput : public ReadingSink {
  public:
    /// `sheets` is the path of the sheet file. Throws Error if the broker refuses the connection.
    StateOutput(const PublishArguments& arguments, const std::string& sheets);

    void take(const Reading& reading) override;

    /// Waits up to 2 s until all messages are sent, and reports the number of sent messages. Throws
    /// Error if no connection to the broker was established.
    void finish() override;

  private:
    StateSource states_;
    publish::MqttPublisher publisher_;
};

}  // namespace dotpose::cli
