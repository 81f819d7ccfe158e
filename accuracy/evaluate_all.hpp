/// Frames located and scored, for programs that count frames.
#pragma once

#include <string>
#include <vector>

#include "counting.hpp"
#include "dotpose/tools/evaluate.hpp"

namespace dotpose {

/// outcomes[k][i]: frame i of the run, located with options[k], on the threads asked for. `what` is
/// shown while it runs. Throws Error if interrupted.
std::vector<std::vector<Outcome>> evaluate_all(const std::string& what, FrameRun run,
                                               const Counting& counting);

}  // namespace dotpose
