/// Stands in for rclcpp, which Debian does not have: what dotpose_ros uses of it, declared by its
/// documentation, so that a compiler can check the rest of the node. Nothing of it runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <builtin_interfaces/msg/time.hpp>

namespace rclcpp {

class NodeOptions {};

class QoS {
  public:
    QoS(std::size_t depth);
    QoS& reliable();
    QoS& transient_local();
};
class SensorDataQoS : public QoS {
  public:
    SensorDataQoS();
};

class Time {
  public:
    Time(const builtin_interfaces::msg::Time& message);
    std::int64_t nanoseconds() const;
};

class Logger {};
class Clock {
  public:
    using SharedPtr = std::shared_ptr<Clock>;
};

template <typename Message>
class Publisher {
  public:
    using SharedPtr = std::shared_ptr<Publisher>;
    void publish(const Message& message);
};
template <typename Message>
class Subscription {
  public:
    using SharedPtr = std::shared_ptr<Subscription>;
};

class Node {
  public:
    Node(const std::string& name, const NodeOptions& options);
    const char* get_name() const;
    Logger get_logger() const;
    Clock::SharedPtr get_clock();
    Time now() const;

    template <typename Value>
    auto declare_parameter(const std::string& name, const Value& standard) -> Value;
    auto declare_parameter(const std::string& name, const char* standard) -> std::string;

    template <typename Message>
    typename Publisher<Message>::SharedPtr create_publisher(const std::string& topic,
                                                            const QoS& quality);
    template <typename Message, typename Callback>
    typename Subscription<Message>::SharedPtr create_subscription(const std::string& topic,
                                                                  const QoS& quality,
                                                                  Callback&& callback) {
        // A callback of this type is one of those that rclcpp takes.
        std::function<void(typename Message::ConstSharedPtr)> checked =
            std::forward<Callback>(callback);
        return nullptr;
    }
};

}  // namespace rclcpp

/// Checks that logger, format and values fit, as rclcpp's macros do by printf.
[[gnu::format(printf, 1, 2)]] void stand_in_log(const char* format, ...);

#define RCLCPP_WARN(logger, ...) (static_cast<void>(logger), stand_in_log(__VA_ARGS__))
#define RCLCPP_WARN_ONCE(logger, ...) RCLCPP_WARN(logger, __VA_ARGS__)
#define RCLCPP_ERROR_THROTTLE(logger, clock, pause_ms, ...)           \
    (static_cast<rclcpp::Clock&>(clock), static_cast<void>(pause_ms), \
     RCLCPP_WARN(logger, __VA_ARGS__))
