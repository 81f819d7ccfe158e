// Steps that desktops and devices share, in integers; each is a part of the paper's Fig. 1.
#pragma once

#include "core/detect/blobs.hpp"
#include "core/detect/light.hpp"
#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

template <typename T, std::size_t Extent>
std::span<T> first(std::span<T, Extent> all, int count) {
    return all.first(static_cast<std::size_t>(count));
}

Vec image_centre_q8(const Light& light);

/// Returns the image point whose pose is wanted, given the image centre.
Vec reference_q8(Vec centre_q8, const Options& options);

/// Returns ok if a frame can be begun, or an image located, otherwise the reason.
Status check(int width_px, int height_px, const Options& options, const Workspace& w);
Status check(const ImageView& image, const Options& options, const Workspace& w);

/// Sets and returns the fix of a frame that is refused before any stage; results of the frame
/// before are cleared.
const Fix& refuse(Status reason, Workspace& w);

/// Clears the results of the frame before.
void forget_frame(Workspace& w);

/// Starts a frame, whose size the workspace must have room for.
void begin_frame(int width_px, int height_px, Workspace& w);

/// Detects the blobs in `ready` bands of rows.
void threshold_bands(int ready, const Options& options, Workspace& w);  // II-B.1

/// Takes the next row of pixels and detects the blobs of the bands that it completes; most rows
/// complete none.
inline void detect_row(const std::uint8_t* pixels, const Options& options, Workspace& w) {
    const int ready = take_row(pixels, w.light);
    if (ready > 0) threshold_bands(ready, options, w);
}

/// Detects the blobs of a whole image.
void detect_image(const ImageView& image, const Options& options, Workspace& w);

/// Selects the dots among the blobs, and moves them to where a lens without distortion would see
/// them. Errors: no_contrast, too_few_dots.
Status find_dots(const Options& options, Workspace& w);

/// Finds the directions and spacings of the grid from connections between the dots nearest a point.
Status find_axes(Vec start_q8, int most_seeds, Workspace& w);

/// Chooses the region of the grid that is decoded, of as many lines as there is memory for.
void choose_region(Workspace& w);

/// Returns `mirrored` if the bits are those of a mirrored pattern, otherwise the reason given.
Status refused(Status reason, const Workspace& w);

}  // namespace dotpose::core
