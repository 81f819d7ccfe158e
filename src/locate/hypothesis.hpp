// Hypothesis: a plane and a place in the code, to be tested by an attempt. This file also declares
// the functions that determine the cells in view.
#pragma once

#include <cstdint>
#include <span>

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"
#include "dotpose/code.hpp"
#include "locate/frame.hpp"

namespace dotpose::core {

/// A plane and a place that are not yet confirmed by bits.
struct Hypothesis {
    /// Map from the image to the upright pattern. Image points are relative to `from_centre`.
    FloatPlane pattern_from_image;
    FloatVec from_centre;       ///< origin of the plane, in px relative to the image centre
    Place place;                ///< place of the plane's cell (0, 0) in the code
    float displacement = 0;     ///< typical distance between dot and intersection, in spacings
    bool is_certain = false;    ///< true if the place needs no confirmation
    bool is_predicted = false;  ///< true if dots are predicted to within a fraction of a pixel
    /// True if each dot is closer to its predicted image position than to the other three possible
    /// dot positions of its cell. The dots are then sampled directly.
    bool is_exact = false;
    /// True if the bits are also read from dots that are cut off by the image border. Such dots are
    /// not used to fit the pose.
    bool reads_cut_dots = false;
    /// True if the pattern may cover only a part of the image, around `from_centre`.
    bool is_partial_view = false;
    /// True if the image is small and shows few cells. A second attempt then rarely succeeds.
    bool is_small_view = false;
    /// Contrast of a typical dot after a 1-2-1 filter along both axes, in 1/256 of the paper level.
    int dot_contrast_q8 = 0;
    /// Mass of a typical dot: the darkness beyond the threshold, relative to the paper level,
    /// summed over the pixels of the dot. The value is 0 if the mass is unknown.
    float typical_mass = 0;
};

/// Returns the plane of a hypothesis, relative to the image centre.
inline FloatPlane centred_plane(const Hypothesis& hypothesis) {
    const FloatVec from = hypothesis.from_centre;
    return recentred(hypothesis.pattern_from_image, {-from.x, -from.y});
}

/// Makes the plane of a hypothesis relative to the image centre.
inline void move_origin_to_centre(Hypothesis& hypothesis) {
    hypothesis.pattern_from_image = centred_plane(hypothesis);
    hypothesis.from_centre = {};
}

/// Memory for the rolls of the columns and rows in view.
struct RollMemory {
    std::span<std::uint8_t> columns;
    std::span<std::uint8_t> rows;
};

/// Threshold for the contrast of a pixel in a window, in 1/256 of the contrast of a typical dot.
/// Pixels with more contrast belong to a dot.
inline constexpr int kContrastCut_q8 = 160;

/// Returns the minimum distance from the image border to the centre of a complete dot, in px. Dots
/// closer to the border may be cut off.
float margin_of_whole_dots_px(float spacing_px);

FloatLens float_lens(const FixedLens& lens);

/// Returns the input of `list_cells` for the cells in view within `reach_px` of `from_centre` along
/// each image axis, subsampled to about `max_cells` cells. Writes the rolls of the columns and rows
/// in view into `rolls`.
CellsInView cells_in_view(const Frame& frame, const Hypothesis& hypothesis, float reach_px,
                          int max_cells, const RollMemory& rolls);

/// Renumbers the cells so that cell (0, 0) contains the intersection nearest to `from_centre`.
void count_from_centre(CodeVariant code, Hypothesis& hypothesis);

/// Similarity transform from predicted to measured dots: shift, scale and rotation, fitted by least
/// squares.
struct Similarity {
    FloatVec shift_px;
    float scale = 0;  ///< scale factor minus 1
    float turn_rad = 0;
    float squares_px2 = 0;  ///< sum of the squared residuals of the fit
};

/// Fits a similarity transform to the offsets in `found`, which must contain at least one dot. Fits
/// only the shift if all dots have the same predicted point.
Similarity similarity_of(const DotOffsets& found);

/// Returns the plane shifted, scaled and rotated by a similarity transform.
FloatPlane moved(const FloatPlane& plane, const Similarity& by);

}  // namespace dotpose::core
