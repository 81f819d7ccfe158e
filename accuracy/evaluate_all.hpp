/// Locates many frames, for programs that count them.
#pragma once

#include <string>
#include <vector>

#include "counting.hpp"
#include "dotpose/tools/evaluate.hpp"

namespace dotpose {

/// Returns outcomes[k][i], the outcome of frame i of the run with options[k]. `what` is shown as
/// progress. Throws Error if interrupted.
std::vector<std::vector<Outcome>> evaluate_all(const std::string& what, FrameRun run,
                                               const Counting& counting);

}  // namespace dotpose
