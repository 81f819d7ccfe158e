// The second attempt: for tilted cameras, bent lenses, noise, uneven light and graphics.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Locates on the filtered image; bits are sampled from the image, not taken from blobs. Calls the
/// steps below, one after the other.
Fix make_second_attempt(const ImageView& image, const Options& options, Workspace& w);

/// Filters the image and finds dots, grid and bits, which do not depend on the profile. Errors:
/// those of the steps; not_certain if it shows two overlapping patterns.
Status see_filtered(const ImageView& image, const Options& options, Workspace& w);

/// Finds the position in the profile of the options. Errors: not_certain if sampling the cells
/// again may help.
Status read_position(const Options& options, Workspace& w);

/// Reads the bits again through grids fitted to the dots of the doubtful position, one grid after
/// the other: if the position is right, they are clearer. The bits before are lost.
Status resample_until_certain(const ImageView& image, const Options& options, Workspace& w);

/// Fits the pose for the position found, and weighs the alternatives in other profiles.
Status measure_and_weigh(const ImageView& image, const Options& options, Workspace& w);

}  // namespace dotpose::core
