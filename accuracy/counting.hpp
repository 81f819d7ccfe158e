/// Common parts of the programs that count wrong fixes: arguments, threads, progress, interruption.
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

#include "../apps/dotpose/command_line.hpp"
#include "../apps/dotpose/progress.hpp"

namespace dotpose {

/// Arguments that all these programs have.
struct Counting {
    std::uint64_t seed = 1;
    unsigned threads = std::max(std::thread::hardware_concurrency(), 1u);

    void add_to(cli::Command& app);
};

/// Adds an option for a number of items, 0 to 2e9.
void add_count(cli::Command& app, const std::string& flag, std::uint64_t& count,
               const std::string& what);

/// The body of main(): reads the arguments and calls `run`, whose result is the exit status.
/// Returns 2 for wrong usage and 1 for other errors. Ctrl-C then ends `count_on_threads` early.
int run_program(cli::Command& app, int argc, char** argv, const std::function<int()>& run);

template <typename Tally>
struct Count {
    Tally tally;
    std::uint64_t asked = 0;
    std::uint64_t done = 0;  ///< number of items done; less than asked if interrupted
    double seconds = 0;
};

/// Returns text such as "12000 frames in 60 s, 200 frames/s", and whether the run was interrupted.
std::string speed_line(const std::string& what, std::uint64_t asked, std::uint64_t done,
                       double seconds);

/// Runs `work(i, tally)` for i from 0 to count - 1, with one Tally for each thread, and adds them
/// with
/// +=. The result does not depend on the number of threads. `what` is shown as progress.
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
