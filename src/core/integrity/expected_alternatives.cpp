#include "core/integrity/expected_alternatives.hpp"

#include <bit>

namespace dotpose::core {

float sum_of_expected_alternatives(const Kernels& kernels, const RankedLines& lines, int max_shared,
                                   int min_different, int max_different) {
    const LikelihoodRatios& ratios = lines.ratios;
    float sum = 0;
    for (unsigned different = 0; different < 16; ++different) {
        const int count = std::popcount(different);
        if (count < min_different || count > max_different) continue;
        sum += kernels.sum_expected_alternatives(ratios.basis, ratios.places, different,
                                                 lines.odds(), max_shared);
    }
    return sum;
}

}  // namespace dotpose::core
