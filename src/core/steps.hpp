// Steps: the steps of the pipeline (paper, figure 1) that desktops and devices share, in integer
// arithmetic.
#pragma once

#include <algorithm>

#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/blobs.hpp"
#include "core/workspace.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

template <typename T, std::size_t Extent>
std::span<T> first(std::span<T, Extent> all, int count) {
    return all.first(static_cast<std::size_t>(count));
}

FixedVec image_centre_q8(const AdaptiveThreshold& threshold);

/// Returns the image point whose pose is reported. `centre_q8` is the image centre.
FixedVec reference_q8(FixedVec centre_q8, const DeviceOptions& options);

/// Returns ok if the options are valid and the workspace accepts frames of this size. Otherwise,
/// returns the reason for rejecting the frame. The second overload also rejects an image without
/// pixels.
Status check(int width_px, int height_px, const DeviceOptions& options, const Workspace& w);
Status check(const ImageView& image, const DeviceOptions& options, const Workspace& w);

/// Rejects a frame before its first stage. Clears the previous results, sets the status of the fix
/// to `reason`, and returns the fix.
const Fix& refuse(Status reason, Workspace& w);

void forget_frame(Workspace& w);

/// Starts a frame. The frame size must be within the limits of the workspace.
void begin_frame(int width_px, int height_px, Workspace& w);

/// Detects blobs in the next `ready` bands of rows (paper, section II-B.1).
void threshold_bands(int ready, const DeviceOptions& options, Workspace& w);

/// Processes the next row of pixels, and detects the blobs of each band that the row completes.
inline void detect_row(const std::uint8_t* pixels, const DeviceOptions& options, Workspace& w) {
    const int ready = take_row(pixels, w.threshold);
    if (ready > 0) threshold_bands(ready, options, w);
}

void detect_image(const ImageView& image, const DeviceOptions& options, Workspace& w);

/// Returns the minimum number of dots in a grid. With known sheets, fewer dots are sufficient.
inline int min_dots(const DeviceOptions& options, const Workspace& w) {
    return w.known.any() ? std::min(options.lattice.min_dots, kMinKnownDots)
                         : options.lattice.min_dots;
}

/// Selects the dots among the blobs and undistorts them. Errors: no_contrast, too_few_dots.
Status find_dots(const DeviceOptions& options, Workspace& w);

/// Finds the directions and spacings of the grid from the vectors between neighbouring dots. Uses
/// at most `max_seeds` dots, in a square around `start_q8`. Error: no_grid.
Status find_axes(FixedVec start_q8, int max_seeds, Workspace& w);

/// Chooses the region of the grid to decode. The memory for line scores limits the numbers of
/// columns and rows in the region.
void choose_region(Workspace& w);

/// Returns `mirrored` if the bits agree with a mirrored pattern, and `reason` otherwise.
Status refused(Status reason, const Workspace& w);

}  // namespace dotpose::core
