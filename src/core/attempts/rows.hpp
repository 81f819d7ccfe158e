// The attempt by rows: for rows that are pushed and not kept, and for images that the first attempt
// does not locate. It suits a camera that looks nearly straight at clean paper.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates a frame from its blobs.
Fix finish_rows(const Options& options, Workspace& w);

/// Whether the dots lie so far from their fitted places that a second attempt may be better.
bool is_rough(const Fix& fix);
bool is_rough(float residual_px, float spacing_px);

}  // namespace dotpose::core
