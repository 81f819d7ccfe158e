// Writes states to a database in the background. While the database is not available, keeps the
// states in memory.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "store/database.hpp"

namespace dotpose::store {

struct QueueOptions {
    /// Maximum number of states in the queue. If the queue is full, a new state replaces the oldest
    /// state that is not in the current transaction. A state takes 96 bytes.
    std::size_t max_states = 1'000'000;
    /// Maximum time for which states are collected before they are written in one transaction.
    /// PostgreSQL stores the states of a transaction together, sorted by robot. The states of one
    /// robot can therefore be read faster if the period is longer.
    std::chrono::milliseconds period{5000};
    int keep_days = 0;  ///< number of days to keep, or 0 to keep all days
    /// Called with messages for the user, for example when the database is not available. May be
    /// called on another thread.
    std::function<void(const std::string&)> notify = [](const std::string&) {};
};

struct QueueStatus {
    std::int64_t stored = 0;
    std::int64_t waiting = 0;
    std::int64_t dropped = 0;
    bool is_away = false;  ///< true after a failed write, until the next successful write
};

class Queue {
  public:
    /// Creates the tables. Throws Error if the database is a file that cannot be opened. If the
    /// database is on a server that is not available, the queue tries again later.
    Queue(std::unique_ptr<Database> database, bool is_on_server, QueueOptions options);
    ~Queue();
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;

    /// Adds a state without waiting. Thread-safe.
    void push(State state);

    QueueStatus status() const;

    /// Writes all states in the queue. Gives up if an attempt fails more than `patience` after the
    /// call. Returns false if some states were not stored. No states may be added afterwards.
    bool finish(std::chrono::milliseconds patience);

  private:
    void run();
    bool take_batch();
    bool try_to_write();
    void remove_old_days();
    void report_failure(const Error& error);

    std::unique_ptr<Database> database_;
    QueueOptions options_;
    std::vector<State> batch_;  ///< states of the current transaction, used only by `thread_`
    bool is_removal_reported_ = false;
    std::int64_t kept_from_ = 0;  ///< first day kept by the last removal of old days
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<State> waiting_;
    QueueStatus status_;
    bool ends_ = false;
    std::chrono::steady_clock::time_point ends_by_;
    std::thread thread_;
};

}  // namespace dotpose::store
