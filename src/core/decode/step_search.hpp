// Step search: finds the position on one axis from the steps between all adjacent lines. A *step*
// is the difference between the rolls of two adjacent lines. Differs: the paper decodes each line
// separately. See docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"

namespace dotpose::core {

/// Computes the loss of score for each possible digit of each step. In each secondary sequence,
/// selects the places with the smallest summed loss over all steps. Then evaluates all combinations
/// of these places, and replaces `best` if a combination has a higher score. Also finds positions
/// that the search by runs of lines misses, for example if graphics hide every sixth line or if no
/// line has a clear roll.
void search_by_steps(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
