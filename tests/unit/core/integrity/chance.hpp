// Computes the exact probability that random bits agree with the code.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dotpose::core_test {

/// Returns log2((L * 63 * 4) * P(Binomial(n, 1/2) <= e)) for e = 0 to n. The factor is the number
/// of hypotheses: positions, sections and turns. The binomial coefficients are represented by their
/// logarithms.
inline std::vector<long double> exact_chance_log2(int n) {
    const long double hypotheses = std::log2(410815348.0L * 63 * 4);
    std::vector<long double> result;
    long double log_coefficient = 0;  // log2 C(n, k)
    long double log_sum = 0;
    for (int k = 0; k <= n; ++k) {
        if (k > 0) {
            log_coefficient += std::log2(static_cast<long double>(n - k + 1)) -
                               std::log2(static_cast<long double>(k));
            const long double larger = std::max(log_sum, log_coefficient);
            log_sum = larger +
                      std::log2(std::exp2(log_sum - larger) + std::exp2(log_coefficient - larger));
        }
        result.push_back(hypotheses + log_sum - n);
    }
    return result;
}

}  // namespace dotpose::core_test
