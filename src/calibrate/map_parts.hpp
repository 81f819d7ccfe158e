// Divides the work on the frames and dots of a print map among the cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace dotpose::calibrate {

/// Number of parts into which the work is divided. The number is constant, because the rounding of
/// sums must not depend on the number of cores.
inline constexpr int kMapParts = 8;

/// Calls `work(part)` for all parts, on all cores.
template <typename Work>
void for_each_part(const Work& work) {
    std::atomic<int> next = 0;
    const auto run = [&] {
        for (int part = next++; part < kMapParts; part = next++)
            work(part);
    };
    const int count =
        std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMapParts);
    std::vector<std::jthread> threads;
    for (int i = 1; i < count; ++i)
        threads.emplace_back(run);
    run();
}

/// Divides the items 0 to count - 1 among the parts, and calls `work(part, item)` for each item.
template <typename Work>
void for_each_item(std::size_t count, const Work& work) {
    const auto begin_of = [count](int part) {
        return count * static_cast<std::size_t>(part) / kMapParts;
    };
    for_each_part([&](int part) {
        for (std::size_t i = begin_of(part); i < begin_of(part + 1); ++i)
            work(part, i);
    });
}

}  // namespace dotpose::calibrate
