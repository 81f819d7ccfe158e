// Single alternatives: positions whose place differs from that of the reading in one secondary
// sequence. See docs/integrity.md, "Alternatives: odds". likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/loss_tables.hpp"
#include "core/integrity/work_limit.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of all single alternatives that share a line with the
/// reading. The sum contains one term for each shift at which an alternative shares a line. Returns
/// nullopt if the computation would exceed the work limit `work`. Negligible odds are rounded up,
/// by less if `extra_bits` is larger (see `extra_bits_for`).
std::optional<float> sum_of_single_alternatives(const Kernels& kernels, const LossTables& lines,
                                                int extra_bits, WorkLimit& work);

}  // namespace dotpose::core
