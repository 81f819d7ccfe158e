#include "advice_worker.hpp"

#include <memory>
#include <utility>

#include "serve/background_thread.hpp"

namespace dotpose::cli {

AdviceWorker::AdviceWorker(std::function<void(const std::string&)> take)
    : take_(std::move(take)), thread_([this] { run(); }) {}

AdviceWorker::~AdviceWorker() {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void AdviceWorker::ask(Job job) {
    {
        const std::lock_guard lock(mutex_);
        waiting_ = std::move(job);
    }
    changed_.notify_one();
}

void AdviceWorker::run() {
    serve::run_in_background();
    const auto scratch = std::make_unique<LargeMemory>();
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stops_ || waiting_; });
        if (stops_) return;
        Job job = *std::exchange(waiting_, std::nullopt);
        lock.unlock();
        job.record.advice = advice_on(job.image.view(), job.facts, *scratch);
        take_(reason(job.record));
        lock.lock();
    }
}

}  // namespace dotpose::cli
