#include "core/pose/quick_median.hpp"

#include <algorithm>

namespace dotpose::core {

std::int32_t quick_median(std::span<const std::int32_t> values) {
    if (values.empty()) return 0;
    // It is the largest number that no more values are below than rank below the median.
    const int rank = (static_cast<int>(values.size()) - 1) / 2;
    std::int32_t low = values[0];
    std::int32_t high = values[0];
    for (const std::int32_t value : values) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    while (low < high) {
        const auto half = (static_cast<std::uint32_t>(high) - static_cast<std::uint32_t>(low)) / 2;
        const std::int32_t middle = high - static_cast<std::int32_t>(half);
        int below = 0;
        for (const std::int32_t value : values)
            below += value < middle ? 1 : 0;
        if (below <= rank) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

}  // namespace dotpose::core
