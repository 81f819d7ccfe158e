/// Removes robots from the broker, and thus from all running fleets.
#pragma once

#include <string>

#include "publish/mqtt.hpp"

namespace dotpose::cli {

class RobotRemover {
  public:
    /// Throws Error if the broker refuses the connection.
    explicit RobotRemover(publish::MqttOptions options);
    /// Waits up to 2 s until all removals are sent.
    ~RobotRemover();
    RobotRemover(const RobotRemover&) = delete;
    RobotRemover& operator=(const RobotRemover&) = delete;

    /// Clears the message that the broker retains for a robot. Does not wait for the broker.
    /// Thread-safe.
    void remove(const std::string& robot);

  private:
    publish::MqttPublisher publisher_;
};

}  // namespace dotpose::cli
