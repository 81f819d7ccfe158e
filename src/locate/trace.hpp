// Trace: stores the results of `confirm` in the part of the workspace that `Locator::trace` reads.
#pragma once

#include "core/workspace.hpp"
#include "locate/confirm.hpp"

namespace dotpose::core {

/// Stores the plane, the place and the number of bits of a confirmed hypothesis. If `with_dots` is
/// true, also stores its dots, and a grid with their bits.
void store_for_trace(const Measurement& measurement, bool with_dots, Workspace& w);

}  // namespace dotpose::core
