// Frames dealt out to threads. What is counted does not depend on how many there are.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace dotpose {

/// Runs work(frame, tally) for frames 0 to frames - 1, with one Tally for each of `threads`
/// threads, and returns their sum (+=).
template <typename Tally, typename Work>
Tally run_on_threads(std::uint64_t frames, unsigned threads, Work work) {
    constexpr std::uint64_t kBatch = 16;
    std::atomic<std::uint64_t> next{0};
    std::vector<Tally> tallies(threads);
    std::vector<std::thread> running;
    for (Tally& tally : tallies) {
        running.emplace_back([&] {
            for (;;) {
                const std::uint64_t first = next.fetch_add(kBatch);
                if (first >= frames) return;
                for (std::uint64_t i = first; i < frames && i < first + kBatch; ++i)
                    work(i, tally);
            }
        });
    }
    for (std::thread& thread : running)
        thread.join();
    Tally sum;
    for (const Tally& tally : tallies)
        sum += tally;
    return sum;
}

}  // namespace dotpose
