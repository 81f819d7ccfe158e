// Passes the newest of a series of values from one thread to another. There is no queue. A value
// that is not taken before the next value arrives is dropped and counted.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace dotpose::video {

template <typename Value>
class Latest {
  public:
    void put(Value value) {
        {
            const std::lock_guard lock(mutex_);
            dropped_ += value_.has_value();
            value_ = std::move(value);
        }
        arrived_.notify_one();
    }

    /// Returns the newest value and removes it. Waits for a value if there is none. Returns an
    /// empty optional if no value arrives within `patience`.
    std::optional<Value> take(std::chrono::milliseconds patience) {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, patience, [this] { return value_.has_value(); });
        return std::exchange(value_, std::nullopt);
    }

    std::int64_t dropped() const {
        const std::lock_guard lock(mutex_);
        return dropped_;
    }

  private:
    mutable std::mutex mutex_;
    std::condition_variable arrived_;
    std::optional<Value> value_;
    std::int64_t dropped_ = 0;
};

}  // namespace dotpose::video
