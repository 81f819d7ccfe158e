// The first attempt of a desktop: locates an image without a prediction, outwards from a patch.
#pragma once

#include <optional>

#include "core/attempts/confirm.hpp"
#include "core/kernels/select.hpp"
#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates from a patch of the image, then outwards. Leaves the fix, if any, in the workspace.
Confirmation locate_outwards(const Kernels& kernels, const ImageView& image, const Options& options,
                             Rough rough, Workspace& w);

/// Whether `locate_outwards` suits the options and has memory.
bool searches_outwards(const Options& options, const Workspace& w);

/// Locates from the blobs of all rows, and measures the dots once more as `locate_outwards`
/// measures them. Leaves the fix in the workspace; returns whether there is one.
bool locate_by_rows(const Kernels& kernels, const ImageView& image, const Options& options,
                    Workspace& w);

/// Locates outwards and, without a fix, by rows. Returns nothing if the frame is left to the second
/// attempt.
std::optional<Fix> make_first_attempt(const ImageView& image, const Options& options, Rough rough,
                                      Workspace& w);

}  // namespace dotpose::core
