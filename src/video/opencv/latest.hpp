// Passes values from one thread to another without a queue. A value that has not been taken when
// the next one arrives is dropped and counted.
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

    /// Waits for a value and removes it. Returns an empty optional if none arrives within
    /// `patience`.
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
