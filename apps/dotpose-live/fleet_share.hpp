/// How several fleets share the robots of a broker.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"

namespace dotpose::cli {

/// One of several parts of all robots, which are divided by a hash of their names: the same on all
/// computers, so that fleets need not know of each other.
struct Shard {
    std::uint64_t index = 1;  ///< from 1 to `count`
    std::uint64_t count = 1;

    bool has(std::string_view robot) const;
};

class ShareArguments {
  public:
    /// Adds --share and --shard.
    void add_to(Command& command);

    /// Returns the topics to subscribe to: states, of which a group gets its part, and connections.
    std::vector<std::string> topics() const;
    bool is_shared() const { return !group_.empty(); }
    const Shard& shard() const { return shard_; }

  private:
    std::string group_;
    Shard shard_;
};

}  // namespace dotpose::cli
