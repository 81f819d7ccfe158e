/// Processes the items of a list in parallel and returns the results in list order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace dotpose::cli {

/// Runs `work` in n threads and returns their results in the order of the items. Thread i must
/// process the items i, i + n, i + 2n, and so on, and emit one result per item.
template <typename Result>
class OrderedThreads {
  public:
    /// Function that a thread calls to deliver a result. Blocks while kMaxResults results from the
    /// thread are queued. Returns false if no more results are needed, in which case the thread
    /// must return.
    using Emit = std::function<bool(Result)>;
    using Work = std::function<void(std::size_t thread, const Emit& emit)>;

    OrderedThreads(std::size_t threads, const Work& work) {
        for (std::size_t i = 0; i < threads; ++i)
            lanes_.push_back(std::make_unique<Lane>());
        for (std::size_t i = 0; i < threads; ++i) {
            Lane& lane = *lanes_[i];
            lane.thread = std::jthread([&lane, work, i](const std::stop_token& stop) {
                try {
                    work(i, [&](Result result) { return lane.put(std::move(result), stop); });
                } catch (...) {
                    lane.failure = std::current_exception();
                }
                lane.end();
            });
        }
    }

    /// Returns the next result, or none after the last result. If the thread that should deliver
    /// the result has failed, rethrows its exception.
    std::optional<Result> next() {
        Lane& lane = *lanes_[next_lane_++ % lanes_.size()];
        std::optional<Result> result = lane.take();
        if (!result && lane.failure) std::rethrow_exception(lane.failure);
        return result;
    }

  private:
    /// A thread and its queue of results.
    struct Lane {
        static constexpr std::size_t kMaxResults = 16;

        bool put(Result result, const std::stop_token& stop) {
            std::unique_lock lock(mutex);
            if (!changed.wait(lock, stop, [this] { return results.size() < kMaxResults; })) {
                return false;
            }
            results.push_back(std::move(result));
            changed.notify_all();
            return true;
        }
        void end() {
            const std::lock_guard lock(mutex);
            has_ended = true;
            changed.notify_all();
        }
        std::optional<Result> take() {
            std::unique_lock lock(mutex);
            changed.wait(lock, [this] { return !results.empty() || has_ended; });
            if (results.empty()) return std::nullopt;
            Result result = std::move(results.front());
            results.pop_front();
            changed.notify_all();
            return result;
        }

        std::mutex mutex;
        std::condition_variable_any changed;
        std::deque<Result> results;
        bool has_ended = false;
        /// Exception that terminated the thread, or null. Set before `has_ended`.
        std::exception_ptr failure;
        /// Declared last, so it is joined before the members that the thread uses are destroyed.
        std::jthread thread;
    };

    std::vector<std::unique_ptr<Lane>> lanes_;
    std::size_t next_lane_ = 0;
};

}  // namespace dotpose::cli
