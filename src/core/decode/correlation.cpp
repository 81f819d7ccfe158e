#include "core/decode/correlation.hpp"

#include "code/sequences.hpp"

namespace dotpose::core {
namespace {

/// The main sequence twice over, bit 1 as +1 and bit 0 as -1, so that 63 signs follow any index.
constexpr auto kSigns = [] {
    std::array<std::int8_t, 2 * kSections> signs{};
    for (std::size_t i = 0; i < signs.size(); ++i) {
        signs[i] = code::kMain[i % kSections] != 0 ? 1 : -1;
    }
    return signs;
}();

}  // namespace

void correlate(std::span<const std::int8_t> weights, LineScores& scores) {
    scores.fill(0);
    std::size_t phase = 0;
    for (const std::int8_t weight : weights) {
        if (weight != 0) {
            const std::int8_t* sign = kSigns.data() + phase;
            for (std::size_t o = 0; o < kSections; ++o) {
                scores[o] = static_cast<std::int16_t>(scores[o] + weight * sign[o]);
            }
        }
        phase = phase + 1 == kSections ? 0 : phase + 1;
    }
}

Match best_match(const LineScores& scores) {
    const auto best = std::max_element(scores.begin(), scores.end());
    return {*best, static_cast<std::uint8_t>(best - scores.begin())};
}

}  // namespace dotpose::core
