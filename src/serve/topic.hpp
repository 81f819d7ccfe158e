// A topic: a value that the program may replace at any time. Clients receive only its newest
// version.
//
// A client receives a value only after it acknowledged earlier values (Subscription). The program
// therefore produces values at the rate of the fastest client, and produces no values while no
// client is ready:
//
//     if (frames.is_wanted()) frames.publish([image = copy_of(image)] { return encode(image); });
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace dotpose::serve {

class Topic {
  public:
    using Encode = std::function<std::string()>;

    Topic(std::string name, bool is_binary) : name_(std::move(name)), is_binary_(is_binary) {}

    // Functions for the program, on any thread.

    /// Returns true if at least one client is ready for a newer value.
    bool is_wanted() const { return ready_clients_.load(std::memory_order_relaxed) > 0; }

    /// Replaces the value. The server calls `encode` on its own thread, at most once, when the
    /// first client is ready. If `encode` throws, the value is empty.
    void publish(Encode encode);

    // Functions for the thread of the server.

    const std::string& name() const { return name_; }
    bool is_binary() const { return is_binary_; }
    /// Returns the number of values that were published.
    std::uint64_t version() const;
    /// Returns the newest value as a message, that is, after the name of the topic and a line
    /// break. Sets `version` to its number. The topic must have a value.
    std::shared_ptr<const std::string> message(std::uint64_t& version);
    void set_ready_clients(int count) { ready_clients_.store(count, std::memory_order_relaxed); }

  private:
    const std::string name_;
    const bool is_binary_;
    std::atomic<int> ready_clients_{0};
    mutable std::mutex mutex_;
    Encode encode_;              ///< encoder of the newest value; null after it was called
    std::uint64_t version_ = 0;  ///< number of the newest value, from 1; 0 if there is none
    std::shared_ptr<const std::string> message_;  ///< newest encoded value
    std::uint64_t message_version_ = 0;
};

/// The state of one client in one topic.
struct Subscription {
    /// Maximum number of unacknowledged messages. With two, the next message is on its way while
    /// the client draws the previous one.
    static constexpr int kMaxUnacknowledged = 2;

    bool is_on = false;
    int unacknowledged = 0;
    std::uint64_t seen = 0;  ///< number of the last value that was sent

    void begin() { *this = {.is_on = true}; }
    void end() { *this = {}; }
    void acknowledge() { unacknowledged -= unacknowledged > 0 ? 1 : 0; }
    /// Returns true if the client may receive a value.
    bool is_open() const { return is_on && unacknowledged < kMaxUnacknowledged; }
    /// Returns true if the client should receive the value with the number `version`.
    bool is_due(std::uint64_t version) const { return is_open() && seen < version; }
    /// Returns true if the client has received the newest value and may receive another one.
    bool is_ready(std::uint64_t version) const { return is_open() && seen == version; }
    void sent(std::uint64_t version) {
        seen = version;
        ++unacknowledged;
    }
};

}  // namespace dotpose::serve
