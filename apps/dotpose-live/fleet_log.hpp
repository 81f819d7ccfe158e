/// Writes the states of all robots to a CSV file with one line per state.
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

    /// Adds a state to the buffer. May be called concurrently with `flush`.
    void add(std::string_view robot, const RobotState& state, std::int64_t received_us);

    /// Writes the buffer to the file. Throws Error if this write or an earlier one failed.
    void flush();

  private:
    std::string path_;
    File file_;
};

}  // namespace dotpose::cli
