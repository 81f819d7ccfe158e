// Search: the position of an axis that agrees best with all lines in view.
// differs: the paper decodes the best 8 x 8 symbols one line at a time; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// How many readings are tried before the best of them is taken.
struct SearchLimits {
    int runs = 24;
    int readings = 64;  ///< of each run
};
/// For first attempts: what is not found so soon is rarely certain.
inline constexpr SearchLimits kBrief{3, 8};

/// Takes runs of consecutive lines, the clearest first, reads each of them in the likeliest ways,
/// and keeps the position that the sum over all lines speaks for. Errors: not_in_code, when no
/// reading of any run stands in the code.
Status find_axis(Profile profile, const Lines& lines, AxisReading& best, SearchLimits limits = {});

}  // namespace dotpose::core
