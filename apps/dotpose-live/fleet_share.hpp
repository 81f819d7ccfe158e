/// Distributes the robots that are connected to a broker over several instances of `dotpose fleet`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// A subset of the robots, selected by a hash of the robot name. The hash is the same on all
/// computers, so the instances of `dotpose fleet` do not need to communicate.
struct Shard {
    std::uint64_t index = 1;  ///< from 1 to `count`
    std::uint64_t count = 1;

    bool has(std::string_view robot) const;
};

class ShareArguments {
  public:
    /// Adds --share and --shard.
    void add_to(Command& command);

    /// Returns the state and connection topics to subscribe to. If the instances form a group, the
    /// broker sends each state to only one instance.
    std::vector<std::string> topics() const;
    bool is_shared() const { return !group_.empty(); }
    const Shard& shard() const { return shard_; }

  private:
    std::string group_;
    Shard shard_;
};

}  // namespace dotpose::cli
