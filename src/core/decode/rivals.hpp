// Rivals: how probable is it that another position than the one found, one that shares some columns
// with it, is the true one? docs/integrity.md derives the sums.
#pragma once

#include "core/decode/lines.hpp"

namespace dotpose::core {

/// How strongly the bits of one axis were read, and how far the code contradicts them.
struct Confidence {
    static constexpr int kBins = 16;
    std::array<std::int32_t, kBins> bits{};  ///< by weight: [0, 8), [8, 16), ...
    std::int32_t wrong_weight = 0;           ///< sum of the weights of the contradicted bits

    void add(int weight, bool is_wrong) {
        const int size = weight < 0 ? -weight : weight;
        ++bits[static_cast<std::size_t>(size * kBins / 128)];
        if (is_wrong) wrong_weight += size;
    }
};

/// The odds, as a power of two in 2^-8, that a bit of weight 127 is right; those of weaker ones
/// grow in proportion to their weight. The value (logistic regression, maximum likelihood) at which
/// as much weight is expected to be wrong as was, and two full bits more; 0 where that says
/// nothing.
int odds_per_bit_q8(const Confidence& confidence);

/// Upper bound, as a power of two, of the summed odds of all rivals of a reading.
int rivals_log2(Profile profile, const Lines& lines, const AxisReading& reading,
                int odds_per_bit_q8);

}  // namespace dotpose::core
