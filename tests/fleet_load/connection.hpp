/// A connection that publishes MQTT messages of QoS 1 in batches: to a broker, or, in place of a
/// broker, to a subscriber.
///
/// It writes packets of MQTT 3.1.1 itself: with a library, which makes several calls of the
/// operating system for each message, the load would take more time than what is to be measured.
#pragma once

#include <cstdint>
#include <string>

namespace dotpose::test {

class Connection {
  public:
    /// Connects to a broker on this computer. Throws std::runtime_error.
    static Connection to_broker(int port, const std::string& client);
    /// Waits for a subscriber, and accepts whatever it subscribes to. Throws std::runtime_error.
    static Connection to_subscriber(int port);

    ~Connection();
    Connection(Connection&& other) noexcept;
    Connection& operator=(Connection&&) = delete;

    /// Whether another message may be published: not too many are without an answer.
    bool has_room() const { return published_ - answered_ < kMaxUnanswered; }
    void publish(const std::string& topic, const std::string& payload);

    /// Sends and receives until `until_us` of the monotonic clock, or until nothing is left to be
    /// sent if that has passed. Throws std::runtime_error if the other side leaves.
    void exchange(std::int64_t until_us);

    std::int64_t published() const { return published_; }
    std::int64_t answered() const { return answered_; }

  private:
    static constexpr std::int64_t kMaxUnanswered = 60'000;

    explicit Connection(int descriptor) : descriptor_(descriptor) {}
    void send_some();
    void receive_some();
    void take(std::uint8_t type, std::string_view body);

    int descriptor_;
    std::string outgoing_;
    std::size_t sent_ = 0;  ///< bytes of `outgoing_` that are sent
    std::string incoming_;
    std::int64_t published_ = 0;
    std::int64_t answered_ = 0;
    bool is_ready_ = false;  ///< connected, or subscribed
};

/// Time on the monotonic clock.
std::int64_t monotonic_us();

}  // namespace dotpose::test
