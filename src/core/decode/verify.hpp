// Verify: all dots in view against the position that a part of them gave, and how probable it is
// that chance would agree as well. differs: the paper accepts whatever decodes; see
// docs/differs-from-paper.md.
#pragma once

#include "core/decode/nominal.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Bits of one axis that were read and compared with the code.
struct Agreement {
    int bits = 0;
    int errors = 0;
};

/// Upper bound, as a power of two, of the probability that `bits` random bits agree with some
/// position, section and turn of one axis in all but `errors` of them: (L * 63 * 4)
/// P(Binomial(bits, 1/2) <= errors), with the entropy bound P <= 2^(-bits (1 - H(errors / bits)))
/// (Cover and Thomas, Elements of Information Theory, 11.1), valid for errors <= bits / 2.
int chance_log2(Agreement agreement);

/// Sets bit_errors and p_wrong_log2 of the fix: from chance, and from rivals (rivals.hpp).
/// Errors: not_certain.
Status verify(const Grid& grid, Profile profile, const Decoding& decoding, const Nominal& nominal,
              const IntegrityOptions& options, std::span<LineScores> storage, Fix& fix);

}  // namespace dotpose::core
