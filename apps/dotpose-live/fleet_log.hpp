/// Writes the states of all robots to a file as CSV, a line each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lines.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

class FleetLog {
  public:
    /// Throws Error if the file cannot be created.
    explicit FleetLog(const std::string& path);

    /// Adds a state. May be called by another thread than `flush`.
    void add(std::string_view robot, const RobotState& state, std::int64_t received_us);

    /// Writes what was added to the file. Throws Error if that was or is not possible.
    void flush();

  private:
    std::string path_;
    File file_;
};

}  // namespace dotpose::cli
