// Step search: finds the position of an axis from the steps between all adjacent lines. A *step* is
// the difference of the rolls of two adjacent lines. differs: the paper decodes each line
// separately; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"

namespace dotpose::core {

/// Computes the loss of each digit of every step. From these losses, finds the places in each
/// secondary sequence that agree best with all steps. Then evaluates all combinations of these
/// places. Replaces `best` if a combination has a higher score. Also finds positions that the
/// search by runs of lines misses, for example if graphics hide every sixth line or if no line has
/// a clear roll.
void search_by_steps(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
