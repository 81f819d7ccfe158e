/// Removes robots from the broker, and thus from all running fleets.
#pragma once

#include <string>

#include "publish/mqtt.hpp"

namespace dotpose::cli {

class RobotRemover {
  public:
    /// Throws Error if the broker rejects the connection.
    explicit RobotRemover(publish::MqttOptions options);
    /// Waits up to 2 s for all removals to be sent.
    ~RobotRemover();
    RobotRemover(const RobotRemover&) = delete;
    RobotRemover& operator=(const RobotRemover&) = delete;

    /// Clears the message that the broker retains for a robot. Returns without waiting for the
    /// broker. Thread-safe.
    void remove(const std::string& robot);

  private:
    publish::MqttPublisher publisher_;
};

}  // namespace dotpose::cli
