// Step search: finds the position on one axis from the steps between adjacent lines. A *step* is
// the difference between the rolls of two adjacent lines. Unlike the paper, this search does not
// decode each line separately. See docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"

namespace dotpose::core {

/// For each secondary sequence, finds the starting indices at which its digits agree best with all
/// steps. Each combination of these indices is a position. Replaces `best` with the position that
/// has the highest score, if this score exceeds that of `best`. Unlike a search by runs of lines
/// (decode/search), this search also finds positions in frames where every sixth line is hidden, or
/// where no line has a clear roll.
void search_by_steps(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
