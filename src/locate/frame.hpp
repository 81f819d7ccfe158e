// Frame: the input of an attempt.
#pragma once

#include "core/kernels/select.hpp"
#include "core/known_sheets.hpp"
#include "core/math/float_plane.hpp"
#include "core/math/readout_turn.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {

/// The image and the other inputs of an attempt.
struct Frame {
    const Kernels& kernels;
    ImageView image;
    const DeviceOptions& options;  ///< `code` is the code of the attempt
    const KnownSheets& known;
    int min_dots = 0;  ///< minimum number of dots in a grid
    /// Rotation during the readout that was removed from `image`. Null if `image` is the original
    /// image.
    const ReadoutTurn* removed_turn = nullptr;
    /// If true, an attempt whose fix is rough may end with Confirmation::rough, without computing
    /// the exact probability that the fix is wrong.
    bool defers_if_rough = false;
};

/// Returns true if the image is small. In small images,
/// - first and tracked attempts have the smaller budget (`WorkLimit::kOfSmallImage`),
/// - a view with few cells is a small view (`Hypothesis::is_small_view`),
/// - too few dots end the search without further attempts, and
/// - an uncertain place ends the search of the first attempt.
inline bool is_small(const ImageView& image) {
    return image.width_px * image.height_px <= tuning::confirm::kMaxPixelsOfSmallImage;
}

/// Returns the image centre, in px relative to the first pixel.
inline FloatVec centre_px(const ImageView& image) {
    return {static_cast<float>(image.width_px - 1) / 2,
            static_cast<float>(image.height_px - 1) / 2};
}

inline FixedVec centre_q8(const ImageView& image) {
    return {(image.width_px - 1) * 128, (image.height_px - 1) * 128};
}

}  // namespace dotpose::core
