// Search: the position of an axis that agrees best with all lines in view.
// differs: the paper decodes the best 8 x 8 symbols one line at a time; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Takes runs of consecutive lines, the clearest first, reads each of them in the likeliest ways,
/// and keeps the position that the sum over all lines speaks for. If that is not clear, all steps
/// between lines are asked as well. Errors: not_in_code, when no reading stands in the code.
Status find_axis(Profile profile, const Lines& lines, AxisReading& best);

/// Only a few runs in a few ways, for first attempts: what is not found so soon is rarely certain.
Status find_axis_briefly(Profile profile, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
