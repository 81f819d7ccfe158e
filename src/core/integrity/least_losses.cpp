#include "core/integrity/least_losses.hpp"

#include <algorithm>

namespace dotpose::core {

OneSide least_losses(const LikelihoodRatios& ratios, bool from_last) {
    const int count = ratios.count();
    const int most_shared = ratios.most_shared();
    OneSide least;
    OneSide with_last;  // of those that do not share the last of the n lines
    with_last[0] = 0;
    int lowest = 0;  // index of the least of these, with no more shared lines since than possible
    for (int n = 0;; ++n) {
        const int last = with_last[static_cast<std::size_t>(n)];
        if (last <= with_last[static_cast<std::size_t>(lowest)]) {
            lowest = n;
        } else if (lowest < n - most_shared) {
            const int* at = with_last.data();
            lowest = static_cast<int>(std::min_element(at + n - most_shared, at + n + 1) - at);
        }
        const int here = with_last[static_cast<std::size_t>(lowest)];
        least[static_cast<std::size_t>(n)] = here;
        if (n == count) return least;
        const int line = from_last ? count - 1 - n : n;
        with_last[static_cast<std::size_t>(n + 1)] = here + std::max(ratios.least_loss(line), 0);
    }
}

int least_loss_with_border(const LikelihoodRatios& ratios) {
    const auto count = static_cast<std::size_t>(ratios.count());
    const OneSide before = least_losses(ratios, false);
    const OneSide beyond = least_losses(ratios, true);
    int least = before[0] + beyond[count];
    for (std::size_t n = 1; n < count; ++n)
        least = std::min(least, before[n] + beyond[count - n]);
    return least;
}

bool surely_lose_with_border(const LikelihoodRatios& ratios, int enough) {
    const int most_shared = 2 * ratios.most_shared();
    int in_a_row = 0;
    for (int line = 0; line < ratios.count(); ++line) {
        in_a_row = ratios.least_loss(line) >= enough ? in_a_row + 1 : 0;
        if (in_a_row > most_shared) return true;
    }
    return false;
}

}  // namespace dotpose::core
