#include "core/integrity/min_losses.hpp"

#include <algorithm>

namespace dotpose::core {

MinLosses min_losses(const LikelihoodRatios& ratios, bool from_last) {
    const int count = ratios.count();
    const int max_shared = ratios.max_shared();
    MinLosses min_loss;
    // Element n is the minimum loss in the first n lines if the last of these lines is not shared.
    MinLosses unshared_last;
    unshared_last[0] = 0;
    int lowest = 0;  // index of the minimum of the last `max_shared` + 1 elements of unshared_last
    for (int n = 0;; ++n) {
        const int last = unshared_last[static_cast<std::size_t>(n)];
        if (last <= unshared_last[static_cast<std::size_t>(lowest)]) {
            lowest = n;
        } else if (lowest < n - max_shared) {
            const int* at = unshared_last.data();
            lowest = static_cast<int>(std::min_element(at + n - max_shared, at + n + 1) - at);
        }
        const int here = unshared_last[static_cast<std::size_t>(lowest)];
        min_loss[static_cast<std::size_t>(n)] = here;
        if (n == count) return min_loss;
        const int line = from_last ? count - 1 - n : n;
        unshared_last[static_cast<std::size_t>(n + 1)] = here + std::max(ratios.min_loss(line), 0);
    }
}

int min_loss_with_border(const LikelihoodRatios& ratios) {
    const auto count = static_cast<std::size_t>(ratios.count());
    const MinLosses before = min_losses(ratios, false);
    const MinLosses beyond = min_losses(ratios, true);
    int min_loss = before[0] + beyond[count];
    for (std::size_t n = 1; n < count; ++n)
        min_loss = std::min(min_loss, before[n] + beyond[count - n]);
    return min_loss;
}

bool must_lose_with_border(const LikelihoodRatios& ratios, int loss_limit) {
    const int max_shared = 2 * ratios.max_shared();
    int in_a_row = 0;
    for (int line = 0; line < ratios.count(); ++line) {
        in_a_row = ratios.min_loss(line) >= loss_limit ? in_a_row + 1 : 0;
        if (in_a_row > max_shared) return true;
    }
    return false;
}

}  // namespace dotpose::core
