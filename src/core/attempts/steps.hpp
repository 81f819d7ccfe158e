// Steps that several attempts share, in integers; each is a part of the paper's Fig. 1.
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

/// Returns where to put the odds of other profiles; null if they are not wanted.
inline OtherCodes* wanted_codes(const Workspace& w) {
    return w.other_codes != nullptr && w.other_codes->are_wanted ? w.other_codes : nullptr;
}

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

/// Finds the grid that the dots lie on, anywhere in the view, for a camera that looks straight at
/// the paper. Errors: no_grid, no_displacement.
Status find_grid(const Options& options, Workspace& w);

/// Chooses the region of the grid that is decoded, of as many lines as there is memory for.
void choose_region(Workspace& w);

/// Returns `mirrored` if the bits are those of a mirrored pattern, otherwise the reason given.
Status refused(Status reason, const Workspace& w);

}  // namespace dotpose::core
