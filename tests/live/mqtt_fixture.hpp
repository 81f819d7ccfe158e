/// Helpers for tests with a mosquitto broker.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "../blackbox/tool_command.hpp"
#include "broker.hpp"
#include "publish/mqtt.hpp"

namespace dotpose::test {

using namespace std::chrono_literals;

inline void wait_until(const std::function<bool()>& condition,
                       std::chrono::milliseconds most = 20s) {
    const auto end = std::chrono::steady_clock::now() + most;
    while (!condition() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(condition());
}

/// Collects messages. Its listener may be called from any thread.
class News {
  public:
    std::function<void(const std::string&)> listener() {
        return [this](const std::string& text) {
            const std::lock_guard lock(mutex_);
            text_ += text + "\n";
        };
    }
    std::string text() const {
        const std::lock_guard lock(mutex_);
        return text_;
    }

  private:
    mutable std::mutex mutex_;
    std::string text_;
};

class Mqtt : public ToolCommand {
  protected:
    publish::MqttOptions options(const Broker& broker) {
        publish::MqttOptions options;
        publish::parse_url(broker.url(), options);
        options.notify = news_.listener();
        return options;
    }
    std::string shell(const std::string& command) {
        EXPECT_EQ(
            std::system(("cd '" + directory_.string() + "' && { " + command + "; } > out").c_str()),
            0);
        return file("out");
    }
    News news_;
};

}  // namespace dotpose::test
