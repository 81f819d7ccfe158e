// Patch hypothesis: finds the grid in a patch and its place in the code. Shared by the first
// attempt and the search for a rotation.
#pragma once

#include "core/kernels/select.hpp"
#include "core/lattice/outwards.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "locate/hypothesis.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Moves the dots to their undistorted image points. The dots are relative to `middle`, in px from
/// the image centre.
void undistort(const FixedLens& lens, FloatVec middle, PatchDots& dots);

/// Returns the middle of a patch, in px relative to the image centre.
FloatVec middle_of(const Patch& patch, const ImageView& image);

/// Places a patch around a point of the image, in px. Returns false if the patch is too small for a
/// grid.
bool place_patch(const ImageView& image, FixedVec around_px, int scale, DesktopWorkspace& w);

/// Finds the dots of the patch, and sets the status of the fix to the status that applies if no
/// patch contains a grid. Returns false, without setting the status, if the patch has no contrast.
bool find_patch_dots(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                     DesktopWorkspace& w);

/// Finds a place in the code from the dots and the grid of a patch. The dots, the grid and the
/// hypothesis are relative to `from_centre`. Returns false if no place is found.
bool read_grid(const Kernels& kernels, const DeviceOptions& options, const PatchGrid& grid,
               FloatVec from_centre, DesktopWorkspace& w, Hypothesis& hypothesis);

/// Finds a grid in the dots of a patch, and its place in the code (see `read_grid`). Returns false
/// if no grid or no place is found.
bool read_hypothesis(const Kernels& kernels, const DeviceOptions& options, const PatchView& view,
                     FloatVec from_centre, DesktopWorkspace& w, Hypothesis& hypothesis);

}  // namespace dotpose::core
