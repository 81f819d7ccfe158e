/// What the programs that count wrong fixes share: arguments, threads, progress, giving up.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "../apps/dotpose/progress.hpp"

namespace dotpose {

/// Arguments of every such program.
struct Counting {
    std::uint64_t seed = 1;
    unsigned threads = std::max(std::thread::hardware_concurrency(), 1u);

    void add_to(CLI::App& app);
};

/// An option for how many items are looked at, 0 to 2e9.
void add_count(CLI::App& app, const std::string& flag, std::uint64_t& count,
               const std::string& what);

/// The whole of a main(): reads the arguments, then calls `run`, whose result is the exit code.
/// Returns 2 on wrong usage and 1 on other errors. From here on Ctrl-C ends `count_on_threads`.
int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& run);

template <typename Tally>
struct Count {
    Tally tally;
    std::uint64_t asked = 0;
    std::uint64_t done = 0;  ///< fewer, if interrupted
    double seconds = 0;
};

/// "12000 frames in 60 s, 200 frames/s", and whether they were interrupted.
std::string speed_line(const std::string& what, std::uint64_t asked, std::uint64_t done,
                       double seconds);

/// Runs work(i, tally) for i from 0 to count - 1, with one Tally for each thread, and sums them
/// (+=). The sum does not depend on how many threads there are. `what` is shown while it runs.
template <typename Tally, typename Work>
Count<Tally> count_on_threads(const std::string& what, std::uint64_t count, unsigned threads,
                              Work work) {
    using namespace std::chrono_literals;
    const auto start = std::chrono::steady_clock::now();
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::uint64_t> done{0};
    std::mutex mutex;
    std::condition_variable one_ended;
    unsigned working = threads;

    std::vector<Tally> tallies(threads);
    std::vector<std::thread> running;
    for (Tally& tally : tallies) {
        running.emplace_back([&] {
            for (;;) {
                const std::uint64_t i = next++;
                if (i >= count || cli::interrupted()) break;
                work(i, tally);
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

    Count<Tally> result{{}, count, done, 0};
    for (const Tally& tally : tallies)
        result.tally += tally;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    result.seconds = taken.count();
    return result;
}

}  // namespace dotpose
