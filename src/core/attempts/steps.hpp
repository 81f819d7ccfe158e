// The steps that several attempts share, in integers; each is one part of the paper's Fig. 1.
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

/// The point whose pose is wanted, in an image whose centre is given.
Vec reference_q8(Vec centre_q8, const Options& options);

/// What is asked for of other profiles; null: nothing.
inline OtherCodes* wanted_codes(const Workspace& w) {
    return w.other_codes != nullptr && w.other_codes->are_wanted ? w.other_codes : nullptr;
}

/// Nothing of the frame before is to be seen any more.
void forget_frame(Workspace& w);

/// Starts a frame of a size that the workspace has room for.
void begin_frame(int width_px, int height_px, Workspace& w);

/// Bands of rows that are ready -> blobs.
void threshold_bands(int ready, const Options& options, Workspace& w);  // II-B.1

/// The next row of pixels -> blobs of the bands that it completes. Most rows complete none.
inline void detect_row(const std::uint8_t* pixels, const Options& options, Workspace& w) {
    const int ready = take_row(pixels, w.light);
    if (ready > 0) threshold_bands(ready, options, w);
}

/// A whole image -> blobs.
void detect_image(const ImageView& image, const Options& options, Workspace& w);

/// Blobs -> dots where a lens without distortion would see them.
Status find_dots(const Options& options, Workspace& w);

/// Dots about a point -> their connections -> directions and spacings of the grid.
Status find_axes(Vec start_q8, int most_seeds, Workspace& w);

/// Dots -> the grid they lie on, wherever in the view that is, for a camera that looks straight at
/// the paper.
Status find_grid(const Options& options, Workspace& w);

/// Grid -> the region that is decoded, of as many lines as there is room for.
void choose_region(Workspace& w);

/// The reason for which bits are refused, or a better one.
Status refused(Status reason, const Workspace& w);

}  // namespace dotpose::core
