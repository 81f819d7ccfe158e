// Dot reader: reads the bits and measures the centres of the listed dots, by direct sampling or in
// windows, depending on the precision of the hypothesis.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/pose/refine_pose.hpp"
#include "locate/confirm.hpp"

namespace dotpose::core {

/// Returns true if the dots of a predicted hypothesis can be sampled directly. Direct sampling
/// reads the bits of a cell from one sample at each of its four places, and measures each centre in
/// a small centroid window.
bool can_sample_directly(const Hypothesis& hypothesis);

/// Returns true if the pixel bias matters. This is the case if all dots of a row or of a column
/// have nearly the same sub-pixel phase, so the bias does not average out, and if the other errors
/// of the dots are small. `variance_px2` is the variance of the mean of all centres along one axis.
/// `side_px` is the longer side of the image.
bool may_be_biased(const FloatPlane& plane, float variance_px2, int side_px);

/// Reads and measures the listed dots. Samples at the four places of each cell if the hypothesis is
/// exact. Otherwise uses windows around the intersections.
class DotReader {
  public:
    DotReader(const Kernels& kernels, const ImageView& image, float spacing_px, MeasuredDots& dots)
        : kernels_(kernels), image_(image), spacing_px_(spacing_px), dots_(dots) {}

    /// Reads the bits of the listed dots. If `block` is not null, stores the bits in this block,
    /// which must be empty. Sets `typical_mass` of the hypothesis, unless the hypothesis is exact.
    BitsRead read(const CellsInView& view, Hypothesis& hypothesis, BitBlock* block);
    /// Reads the bits of the measured dots again, with the new plane of the hypothesis. Overwrites
    /// the block.
    BitsRead read_again(const Hypothesis& hypothesis, BitBlock& block) const;
    /// Measures the centres of the dots in centroid windows. If the hypothesis is not exact, does
    /// so only if `is_last` is true. If the hypothesis is exact, also fits the plane of the
    /// hypothesis to the centres, and sets `projected`, `squares` and `right` of `bits`. `right` is
    /// then the number of dots found. If fewer than kMinFound dots are found, sets only `right`, to
    /// 0.
    void find_centres(const CellsInView& view, Hypothesis& hypothesis, bool is_last,
                      BitsRead& bits) const;
    /// If the pixel bias matters (see `may_be_biased`), measures the centres again and subtracts
    /// the bias. The plane must have been fitted to the current centres, and must be fitted again
    /// afterwards. Sets `remaining_px2` to the variance of the mean of the centres that is due to
    /// the remaining bias. Returns false without any change if the bias does not matter.
    bool correct_pixel_bias(const CellsInView& view, const Hypothesis& hypothesis,
                            const PoseFit& fit, FloatVec& remaining_px2) const;
    /// Corrects the bias of facing dots if the centroid windows reach the neighbouring dot. The
    /// plane must be fitted again afterwards. Returns false without any change if there is no such
    /// bias.
    bool correct_neighbour_bias(const Hypothesis& hypothesis, const PoseFit& fit) const;
    const MeasuredDots& dots() const { return dots_; }

  private:
    WindowOptions window_options(const Hypothesis& hypothesis) const;

    const Kernels& kernels_;
    const ImageView& image_;
    const float spacing_px_;
    MeasuredDots& dots_;
    float typical_mass_ = 0;
    float paper_ = 0;  ///< mean paper level around dots; 0 if not yet known
};

}  // namespace dotpose::core
