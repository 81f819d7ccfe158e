// Single alternatives: positions whose place differs from that of the reading in one secondary
// sequence. See docs/integrity.md, "Alternatives: odds". likelihood_ratios.hpp defines the terms.
#pragma once

#include <optional>

#include "core/integrity/ranked_lines.hpp"
#include "core/integrity/work_limit.hpp"

namespace dotpose::core {

/// Returns an upper bound on the summed odds of all single alternatives that share a line with the
/// reading. The sum contains one term for each shift at which an alternative shares a line.
float sum_of_single_alternatives(const Kernels& kernels, const RankedLines& lines);

/// Variant with a bounded amount of computation, for small views. Returns nullopt if the
/// computation would exceed the work limit `work`, or if `Kernels::list_similar_places` returns
/// false.
std::optional<float> sum_of_single_alternatives(const Kernels& kernels, const RankedLines& lines,
                                                WorkLimit& work);

}  // namespace dotpose::core
