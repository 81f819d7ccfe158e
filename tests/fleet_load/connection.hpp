/// A connection that publishes MQTT messages with QoS 1 in batches. It connects to a broker, or
/// acts as a broker for a subscriber.
///
/// The connection writes MQTT 3.1.1 packets without a library, because a library makes several
/// system calls per message and would need more time than the program under test.
#pragma once

#include <cstdint>
#include <string>

namespace dotpose::test {

class Connection {
  public:
    /// Connects to a broker on this computer. Throws std::runtime_error if that fails.
    static Connection to_broker(int port, const std::string& client);
    /// Waits until a subscriber connects, and accepts any subscription. Throws std::runtime_error
    /// if no subscriber connects.
    static Connection to_subscriber(int port);

    ~Connection();
    Connection(Connection&& other) noexcept;
    Connection& operator=(Connection&&) = delete;

    /// Returns true if another message may be published because the number of unacknowledged
    /// messages is below the limit.
    bool has_room() const { return published_ - answered_ < kMaxUnanswered; }
    void publish(const std::string& topic, const std::string& payload);

    /// Sends and receives until the monotonic clock reaches `until_us` and all data has been sent.
    /// Throws std::runtime_error if the other side disconnects.
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
    std::size_t sent_ = 0;  ///< number of bytes of `outgoing_` that have been sent
    std::string incoming_;
    std::int64_t published_ = 0;
    std::int64_t answered_ = 0;
    /// True once a connect acknowledgement or a subscribe request has been received.
    bool is_ready_ = false;
};

std::int64_t monotonic_us();

}  // namespace dotpose::test
