#include "table_run.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <memory>
#include <mutex>

#include <fmt/core.h>

#include "../apps/dotpose/terminal_text.hpp"

namespace dotpose::tables {

std::string Done::speed_text(const std::string& items) const {
    const double speed = seconds > 0 ? static_cast<double>(done) / seconds : 0;
    return fmt::format(
        "{} {} in {:.0f} s, {:.0f} {}/s{}", done, items, seconds, speed, items,
        is_complete() ? "" : fmt::format(" (interrupted; {} were asked for)", wanted));
}

void TableRun::add_count(const std::string& flag, std::uint64_t& count, const std::string& what) {
    constexpr std::uint64_t kMax = 2'000'000'000;
    command.add_option(flag, count, what)
        ->check(cli::Range(std::uint64_t{0}, kMax))
        ->capture_default_str();
}

void TableRun::add_seed() {
    command.add_option("--seed", seed, "Another seed gives other frames")->capture_default_str();
}

void TableRun::add_threads() {
    command.add_option("--threads", threads, "Default: one for each processor")
        ->check(cli::Range(1, 1024));
}

void TableRun::add_update() {
    command.add_option("--update", document_, "Document whose tables are to be replaced");
}

bool TableRun::parse() {
    if (!command.parse(argc_, argv_)) return false;
    // Reports an unreadable document before the measurement starts, because the measurement may
    // take an hour.
    if (!document_.empty()) read_document(document_);
    return true;
}

Done TableRun::on_threads(const std::string& what, std::uint64_t count,
                          const std::function<void(std::uint64_t, unsigned)>& work) const {
    using namespace std::chrono_literals;
    const auto start = std::chrono::steady_clock::now();
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::uint64_t> done{0};
    std::mutex mutex;
    std::condition_variable one_ended;
    unsigned working = threads;

    std::vector<std::thread> running;
    for (unsigned thread = 0; thread < threads; ++thread) {
        running.emplace_back([&, thread] {
            for (std::uint64_t i = next++; i < count && !cli::interrupted(); i = next++) {
                work(i, thread);
                ++done;
            }
            const std::lock_guard lock(mutex);
            --working;
            one_ended.notify_one();
        });
    }
    {
        cli::ProgressLine progress(what);
        std::unique_lock lock(mutex);
        while (!one_ended.wait_for(lock, 100ms, [&] { return working == 0; }))
            progress.update(static_cast<int>(done), static_cast<int>(count));
    }
    for (std::thread& thread : running)
        thread.join();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return {count, done, elapsed.count()};
}

std::vector<std::vector<Outcome>> TableRun::evaluate(const std::string& what,
                                                     FrameRun frames) const {
    cli::ProgressLine progress(what);
    frames.threads = static_cast<int>(threads);
    frames.progress = shown_on(progress);
    return dotpose::evaluate(frames);
}

void TableRun::print_block(const std::string& name, const std::string& text) {
    fmt::print("{}\n", text);
    std::fflush(stdout);
    blocks_.push_back({name, text});
}

void TableRun::update_document() const {
    if (document_.empty()) return;
    if (cli::interrupted()) {
        cli::notify(fmt::format("interrupted; {} keeps its tables", document_));
        return;
    }
    dotpose::update_document(document_, blocks_);
}

Progress shown_on(cli::ProgressLine& line) {
    return [&line](int done, int total) {
        line.update(done, total);
        return !cli::interrupted();
    };
}

LargeMemory& thread_memory() {
    thread_local const auto kMemory = std::make_unique<LargeMemory>();
    return *kMemory;
}

KnownFrame known_frame(const Shot& shot) {
    return {render(shot), truth_of(shot), {}, {}};
}

Setup setup_of(std::uint64_t seed, int width_px, int height_px) {
    Setup setup;
    setup.seed = seed;
    setup.camera.width_px = width_px;
    setup.camera.height_px = height_px;
    return setup;
}

}  // namespace dotpose::tables
