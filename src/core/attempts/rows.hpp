// The attempt for rows that are pushed and gone, and for images of which the first attempt made
// nothing: for a camera that looks rather straight at clean paper.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates from the blobs of a frame.
Fix finish_rows(const Options& options, Workspace& w);

/// Whether the dots lie so far from where the fix has them that a second attempt is worth while.
bool is_rough(const Fix& fix);

}  // namespace dotpose::core
