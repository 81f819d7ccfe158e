/// States of many simulated robots, in the format in which `dotpose watch --mqtt` publishes them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dotpose::test {

/// Robots that drive in circles. Their names are robot0, robot1, and so on. The message texts are
/// prepared in advance, so that sending a state takes little time.
class Robots {
  public:
    Robots(int first, int count);

    int count() const { return static_cast<int>(topics_.size()); }
    const std::string& topic(int robot) const { return topics_[index(robot)]; }
    /// Returns message `number` of a robot. `timestamp` is the time at which the message is sent.
    std::string state(int robot, std::int64_t number, const std::string& timestamp) const;

  private:
    static std::size_t index(int robot) { return static_cast<std::size_t>(robot); }

    std::vector<std::string> topics_;
    /// The part of a message that follows its number and time, indexed by robot and point on the
    /// circle.
    std::vector<std::vector<std::string>> tails_;
};

/// Returns the current time in the format used in messages.
std::string timestamp_now();

}  // namespace dotpose::test
