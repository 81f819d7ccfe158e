/// Runs `dotpose fleet` as a separate program while a test publishes states.
#pragma once

#include <csignal>
#include <string>
#include <thread>

#include "../paths.hpp"
#include "mqtt_fixture.hpp"

namespace dotpose::test {

/// Runs `dotpose fleet` in the background, in the given directory. The constructor returns when the
/// fleet has subscribed.
class WatchedFleet {
  public:
    WatchedFleet(const fs::path& directory, const std::string& arguments)
        : directory_(directory), thread_([directory, arguments] {
              run_shell("cd '" + directory.string() + "' && echo $$ > fleet.pid && exec '" +
                        tool_path() + "' fleet --draw fleet.svg --every 0.2 " + arguments +
                        " > table 2> news");
          }) {
        wait_until([this] { return fs::exists(directory_ / "fleet.svg"); });
    }
    /// Stops the program, and returns the last table that it wrote.
    std::string table() {
        signal(SIGINT);
        thread_.join();
        return read_file(directory_ / "table");
    }

    void signal(int number) const { kill(std::stoi(read_file(directory_ / "fleet.pid")), number); }

  private:
    fs::path directory_;
    std::thread thread_;
};

}  // namespace dotpose::test
