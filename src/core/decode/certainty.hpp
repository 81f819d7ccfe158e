// Certainty: how probable it is that a position is wrong whose lines are scored: by chance, by
// rivals, and by seams. docs/integrity.md derives it.
#pragma once

#include "core/decode/confidence.hpp"
#include "core/decode/lines.hpp"
#include "core/kernels/kernels.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// What speaks for a position and against it.
struct Evidence {
    Place corner;                    ///< of the first column and row
    std::array<Confidence, 2> bits;  ///< of x and of y, against the code
    Lines columns;
    Lines rows;
};

/// Sets bit_errors and p_wrong_log2 of the fix: an upper estimate, in integers (quick_rivals.hpp).
/// False if the position is not certain enough, or too many bits contradict it.
bool is_certain(const Kernels& kernels, const Evidence& evidence, Profile profile,
                const IntegrityOptions& options, Fix& fix);

}  // namespace dotpose::core
