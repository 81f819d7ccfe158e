#include "core/integrity/expected_double_alternatives.hpp"

namespace dotpose::core {

static_assert(std::tuple_size_v<OddsByShared> == kMinFound);

std::array<float, kMinFound + 1> expected_double_alternatives(const Kernels& kernels,
                                                              const RankedLines& lines,
                                                              int anchors) {
    std::uint64_t is_anchor = 0;
    for (int line = 0; line < lines.count(); ++line) {
        if (lines.rank(static_cast<std::uint32_t>(line)) < anchors)
            is_anchor |= std::uint64_t{1} << line;
    }
    OddsByShared totals;
    kernels.sum_expected_doubles(lines.ratios.basis, lines.ratios.places, lines.odds(), is_anchor,
                                 totals);
    std::array<float, kMinFound + 1> fewer{};
    for (std::size_t n = 0; n < totals.size(); ++n)
        fewer[n + 1] = fewer[n] + totals[n];
    return fewer;
}

}  // namespace dotpose::core
