// A topic: a value that the program may replace at any time. Clients receive only its newest
// version.
//
// A client receives a value only after it has acknowledged earlier values (Subscription). The
// program therefore produces values at the rate of the fastest client, and produces no values while
// no client is ready:
//
//     if (frames.is_wanted()) frames.publish([image = copy_of(image)] { return encode(image); });
//
// A value may depend on the request of each client, such as the part of a map that the client
// displays (`publish_for_each`).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "serve/command.hpp"

namespace dotpose::serve {

class Topic {
  public:
    using Encode = std::function<std::string()>;
    using EncodeFor = std::function<std::string(const Command& request)>;

    Topic(std::string name, bool is_binary) : name_(std::move(name)), is_binary_(is_binary) {}

    // The program may call the following functions on any thread.

    /// Returns true if at least one client is ready for a newer value.
    bool is_wanted() const { return ready_clients_.load(std::memory_order_relaxed) > 0; }

    /// Replaces the value. The server calls `encode` on its own thread, at most once, when the
    /// first client is ready. If `encode` throws, the value is empty.
    void publish(Encode encode);

    /// Replaces the value. The server calls `encode` on its own thread, for each client that is
    /// ready, and again whenever a client changes its request. `request` is the command with which
    /// the client subscribed. It is not validated. If `encode` throws, the value is empty.
    void publish_for_each(EncodeFor encode);

    // The server calls the following functions on its own thread.

    const std::string& name() const { return name_; }
    bool is_binary() const { return is_binary_; }
    /// Returns the number of values published so far.
    std::uint64_t version() const;
    /// Returns the message with the newest value: the name of the topic, a line break, and the
    /// value. Sets `version` to the number of the value. The topic must have a value.
    std::shared_ptr<const std::string> message(std::uint64_t& version, const Command& request = {});
    void set_ready_clients(int count) { ready_clients_.store(count, std::memory_order_relaxed); }

  private:
    void replace(Encode encode, std::shared_ptr<const EncodeFor> encode_for);
    std::shared_ptr<const std::string> message_of(const std::string& value) const;

    const std::string name_;
    const bool is_binary_;
    std::atomic<int> ready_clients_{0};
    mutable std::mutex mutex_;
    Encode encode_;  ///< encoder of the newest value, or null once it has been called
    /// Encoder of the newest value if the value depends on the client, otherwise null.
    std::shared_ptr<const EncodeFor> encode_for_;
    /// Number of the newest value, counted from 1, or 0 if there is none.
    std::uint64_t version_ = 0;
    std::shared_ptr<const std::string> message_;  ///< newest encoded value
    std::uint64_t message_version_ = 0;
};

/// The subscription of one client to one topic.
struct Subscription {
    /// Maximum number of unacknowledged messages. A limit of two allows the next message to be
    /// transmitted while the client draws the previous one.
    static constexpr int kMaxUnacknowledged = 2;

    bool is_on = false;
    int unacknowledged = 0;
    std::uint64_t seen = 0;   ///< number of the last value that was sent
    Command request;          ///< the command with which the client subscribed
    bool is_changed = false;  ///< true if no value has been sent for the request yet

    /// Begins the subscription, or changes its request.
    void begin(Command command = {}) {
        is_on = true;
        is_changed = true;
        request = std::move(command);
    }
    void end() { *this = {}; }
    void acknowledge() { unacknowledged -= unacknowledged > 0 ? 1 : 0; }
    /// Returns true if the client may receive a value.
    bool is_open() const { return is_on && unacknowledged < kMaxUnacknowledged; }
    /// Returns true if the client should receive value number `version`. A client that has changed
    /// its request receives the same value again, encoded for the new request, but only after it
    /// has acknowledged all messages. Without this condition, a client that keeps changing its
    /// request would receive no newer values.
    bool is_due(std::uint64_t version) const {
        const bool is_answer_due = is_on && is_changed && unacknowledged == 0 && version > 0;
        return is_answer_due || (is_open() && seen < version);
    }
    /// Returns true if the client has received the newest value and may receive another one.
    bool is_ready(std::uint64_t version) const { return is_open() && seen == version; }
    void sent(std::uint64_t version) {
        seen = version;
        is_changed = false;
        ++unacknowledged;
    }
};

}  // namespace dotpose::serve
