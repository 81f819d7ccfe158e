// Step search: the position of an axis from the steps between neighbouring lines, wherever they
// are.
// differs: the paper decodes each line by itself; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"

namespace dotpose::core {

/// Finds which digits every step between two lines may have, in each secondary sequence the places
/// that all steps together speak for, and the best position that combines such places; replaces
/// `best` if it is better. Finds what runs of lines do not tell, as where graphics hide every sixth
/// line, or no line is sure of its roll.
void search_by_steps(Profile profile, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
