// Steps: the position of an axis from the steps between neighbouring lines, wherever they are.
// differs: the paper decodes each line by itself; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"

namespace dotpose::core {

/// Lets every step between two lines say which digits it may be made of, looks in each secondary
/// sequence for the places that all steps together speak for, and keeps the best position that
/// some of these places make up, if it is better than `best`. Finds what runs of lines do not tell:
/// where graphics hide every sixth line, or no line is sure of its roll.
void search_by_steps(Profile profile, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
