// Step search: finds the position of an axis from the steps between all neighbouring lines.
// differs: the paper decodes each line separately; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"

namespace dotpose::core {

/// Finds the loss of each digit of every step between two lines, then the places in each secondary
/// sequence that agree best with all steps, and then the best position among the combinations of
/// these places. Replaces `best` if this position has a higher score. Also finds positions that the
/// search by runs of lines misses, for example if graphics hide every sixth line or if no line has
/// a clear roll.
void search_by_steps(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
