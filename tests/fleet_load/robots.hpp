/// States of many simulated robots, as `dotpose watch --mqtt` publishes them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dotpose::test {

/// A number of robots that drive in circles, named robot0 and so on. Texts are made beforehand, so
/// that a state costs little when it is sent.
class Robots {
  public:
    Robots(int first, int count);

    int count() const { return static_cast<int>(topics_.size()); }
    const std::string& topic(int robot) const { return topics_[index(robot)]; }
    /// Returns the state with this number, sent at `timestamp`.
    std::string state(int robot, std::int64_t number, const std::string& timestamp) const;

  private:
    static std::size_t index(int robot) { return static_cast<std::size_t>(robot); }

    std::vector<std::string> topics_;
    /// Of each robot, for some points of its circle, the message after number and time.
    std::vector<std::vector<std::string>> tails_;
};

/// Returns this moment as messages tell it.
std::string timestamp_now();

}  // namespace dotpose::test
