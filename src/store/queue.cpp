#include "store/queue.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "store/schema.hpp"

namespace dotpose::store {
namespace {

using std::chrono::steady_clock;

constexpr std::size_t kMaxBatch = 50'000;
constexpr auto kBetweenAttempts = std::chrono::seconds(1);

std::int64_t today() {
    using namespace std::chrono;
    return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count() / kDay_us;
}

}  // namespace

Queue::Queue(std::unique_ptr<Database> database, bool is_on_server, QueueOptions options)
    : database_(std::move(database)), options_(std::move(options)) {
    try {
        database_->prepare();
    } catch (const Error& error) {
        if (!is_on_server) throw;
        report_failure(error);
    }
    thread_ = std::thread([this] { run(); });
}

Queue::~Queue() {
    finish({});
}

void Queue::push(State state) {
    bool is_first_dropped = false;
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(state));
        ++status_.waiting;
        if (static_cast<std::size_t>(status_.waiting) > options_.max_states) {
            waiting_.pop_front();
            --status_.waiting;
            is_first_dropped = status_.dropped++ == 0;
        }
        if (waiting_.size() == kMaxBatch) changed_.notify_all();
    }
    // Calls `notify` without holding the lock, because the function may use the queue.
    if (is_first_dropped) {
        options_.notify(fmt::format("{}: more than {} states wait; the oldest are dropped",
                                    database_->label(), options_.max_states));
    }
}

QueueStatus Queue::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

bool Queue::finish(std::chrono::milliseconds patience) {
    if (thread_.joinable()) {
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
            ends_by_ = steady_clock::now() + patience;
        }
        changed_.notify_all();
        thread_.join();
    }
    return status().waiting == 0;
}

void Queue::run() {
    while (take_batch()) {
        while (!try_to_write()) {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, kBetweenAttempts, [this] { return ends_; });
            if (ends_ && steady_clock::now() >= ends_by_) return;
            // Once `ends_` is true, the wait above returns immediately, so this wait limits the
            // rate of attempts.
            if (ends_) changed_.wait_for(lock, kBetweenAttempts / 10);
        }
        remove_old_days();
    }
}

/// Waits until the queue contains kMaxBatch states, `options_.period` has elapsed, or `finish` is
/// called. Then moves up to kMaxBatch states from the queue to `batch_`, in the order in which they
/// are stored. Returns false if the queue is empty and `finish` was called.
bool Queue::take_batch() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, options_.period,
                      [this] { return ends_ || waiting_.size() >= kMaxBatch; });
    if (waiting_.empty()) return !ends_;
    const auto end =
        waiting_.begin() + static_cast<std::ptrdiff_t>(std::min(waiting_.size(), kMaxBatch));
    batch_.assign(std::move_iterator(waiting_.begin()), std::move_iterator(end));
    waiting_.erase(waiting_.begin(), end);
    lock.unlock();
    std::ranges::sort(batch_, {}, [](const State& state) {
        return std::tuple(std::string_view(*state.robot), state.time_us, state.number);
    });
    return true;
}

bool Queue::try_to_write() {
    try {
        if (!batch_.empty()) database_->write(batch_);
    } catch (const Error& error) {
        report_failure(error);
        return false;
    }
    const auto count = static_cast<std::int64_t>(batch_.size());
    batch_.clear();
    bool was_away = false;
    {
        const std::lock_guard lock(mutex_);
        status_.stored += count;
        status_.waiting -= count;
        was_away = count > 0 && std::exchange(status_.is_away, false);
    }
    if (was_away) options_.notify(database_->label() + " answers again");
    return true;
}

void Queue::remove_old_days() {
    if (options_.keep_days == 0 || kept_from_ == today() - options_.keep_days) return;
    try {
        const std::int64_t first = today() - options_.keep_days;
        database_->remove_days_before(first * kDay_us);
        kept_from_ = first;
        is_removal_reported_ = false;
    } catch (const Error& error) {
        if (std::exchange(is_removal_reported_, true)) return;
        options_.notify(fmt::format("cannot remove old days from {}: {}; trying again",
                                    database_->label(), error.what()));
    }
}

void Queue::report_failure(const Error& error) {
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(status_.is_away, true)) return;
    }
    options_.notify(fmt::format("cannot store states in {}: {}; trying again", database_->label(),
                                error.what()));
}

}  // namespace dotpose::store
