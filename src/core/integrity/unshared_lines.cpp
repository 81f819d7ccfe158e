#include "core/integrity/unshared_lines.hpp"

#include <algorithm>

#include "code/unshared_lines.hpp"

namespace dotpose::core {

std::span<const std::int16_t> UnsharedLines::choose_lines(int most_lines) {
    const auto& numbers = code::kUnsharedOf;
    static_assert(code::kUnsharedOf.back() == kMostLines);
    std::size_t rows = 0;
    while (rows < numbers.size() && numbers[rows] <= std::min(ratios_.count(), most_lines))
        ++rows;
    if (rows == 0) return {};
    row_ = rows - 1;
    const int lines = numbers[row_];
    const int first = (ratios_.count() - lines) / 2;
    first_line_ = static_cast<std::uint32_t>(first);
    return ratios_.least_losses(first, lines);
}

UnsharedLines::UnsharedLines(const LikelihoodRatios& ratios, int most_lines) : ratios_(ratios) {
    const auto losses = choose_lines(most_lines);
    if (losses.empty()) return;
    // The smallest losses, in order; further ones are sorted in as they come.
    std::fill(least_.begin() + 1, least_.end(), INT32_MAX);
    for (const std::int16_t any : losses) {
        const auto loss = std::max<std::int32_t>(any, 0);
        if (loss >= least_.back()) continue;
        std::size_t i = least_.size() - 1;
        for (; least_[i - 1] > loss; --i)
            least_[i] = least_[i - 1];
        least_[i] = loss;
    }
    for (std::size_t n = 1; n < least_.size(); ++n)
        least_[n] += least_[n - 1];
}

UnsharedLines::UnsharedLines(const Kernels& kernels, const LikelihoodRatios& ratios, int most_lines)
    : ratios_(ratios) {
    const auto losses = choose_lines(most_lines);
    if (!losses.empty()) kernels.sum_least_losses(losses, least_);
}

int UnsharedLines::least_loss(std::size_t sequence, Sharing sharing) const {
    return least_[least_unshared(sequence, sharing)];
}

int UnsharedLines::least_loss(const std::array<std::string_view, 3>& unshared_in_other) const {
    if (row_ == SIZE_MAX) return 0;
    const std::string_view row = unshared_in_other[row_];
    const std::size_t ahead = ratios_.places[3] + first_line_;
    const char unshared = row[ahead < row.size() ? ahead : ahead - row.size()];
    return least_[static_cast<std::size_t>(unshared - '0')];
}

}  // namespace dotpose::core
