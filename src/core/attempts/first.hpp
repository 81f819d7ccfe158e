// The first attempt: for a camera that looks rather straight at clean paper. It sees every row only
// once, so rows may come in one by one.
#pragma once

#include "dotpose/options.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Locates from the blobs of a frame.
Fix finish_first_attempt(const Options& options, Workspace& w);

/// Whether the dots lie so far from where the fix has them that a second attempt is worth while.
bool is_rough(const Fix& fix);

}  // namespace dotpose::core
