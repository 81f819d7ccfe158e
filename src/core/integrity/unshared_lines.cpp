#include "core/integrity/unshared_lines.hpp"

#include <algorithm>

#include "code/unshared_lines.hpp"

namespace dotpose::core {

std::span<const std::int16_t> UnsharedLines::choose_lines(int max_lines) {
    const auto& numbers = code::kUnsharedOf;
    static_assert(code::kUnsharedOf.back() == kMaxTableLines);
    std::size_t rows = 0;
    while (rows < numbers.size() && numbers[rows] <= std::min(ratios_.count(), max_lines))
        ++rows;
    if (rows == 0) return {};
    row_ = rows - 1;
    const int lines = numbers[row_];
    const int first = (ratios_.count() - lines) / 2;
    first_line_ = static_cast<std::uint32_t>(first);
    return ratios_.min_losses(first, lines);
}

UnsharedLines::UnsharedLines(const LikelihoodRatios& ratios, int max_lines) : ratios_(ratios) {
    const auto losses = choose_lines(max_lines);
    if (losses.empty()) return;
    // Insertion sort that keeps only the smallest losses.
    std::fill(smallest_sums_.begin() + 1, smallest_sums_.end(), INT32_MAX);
    for (const std::int16_t any : losses) {
        const auto loss = std::max<std::int32_t>(any, 0);
        if (loss >= smallest_sums_.back()) continue;
        std::size_t i = smallest_sums_.size() - 1;
        for (; smallest_sums_[i - 1] > loss; --i)
            smallest_sums_[i] = smallest_sums_[i - 1];
        smallest_sums_[i] = loss;
    }
    for (std::size_t n = 1; n < smallest_sums_.size(); ++n)
        smallest_sums_[n] += smallest_sums_[n - 1];
}

UnsharedLines::UnsharedLines(const Kernels& kernels, const LikelihoodRatios& ratios, int max_lines)
    : ratios_(ratios) {
    const auto losses = choose_lines(max_lines);
    if (!losses.empty()) kernels.sum_smallest_losses(losses, smallest_sums_);
}

int UnsharedLines::min_loss(std::size_t sequence, Sharing sharing) const {
    return smallest_sums_[min_unshared(sequence, sharing)];
}

int UnsharedLines::min_loss(const std::array<std::string_view, 3>& unshared_in_other) const {
    if (row_ == SIZE_MAX) return 0;
    const std::string_view row = unshared_in_other[row_];
    const std::size_t ahead = ratios_.places[3] + first_line_;
    const char unshared = row[ahead < row.size() ? ahead : ahead - row.size()];
    return smallest_sums_[static_cast<std::size_t>(unshared - '0')];
}

}  // namespace dotpose::core
