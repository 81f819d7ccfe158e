// Dot reader: reads the bits and measures the centres of listed dots, by direct sampling or in
// windows, depending on how exactly the hypothesis predicts them.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/pose/refine_pose.hpp"
#include "locate/confirm.hpp"

namespace dotpose::core {

/// Returns true if the dots of a predicted hypothesis can be sampled directly: each bit from one
/// sample at each place of the cell, each centre in a small centroid window.
bool can_sample_directly(const Hypothesis& hypothesis);

/// Returns true if all dots in view have the same sub-pixel phase, so that the pixel bias does not
/// average out, and the dots are otherwise exact enough for the bias to matter. `variance_px2` is
/// the variance of the mean of their centres along one axis, `side_px` the longer side of the
/// image.
bool may_be_biased(const FloatPlane& plane, float variance_px2, int side_px);

/// Reads and measures the listed dots: directly at their places if the hypothesis is exact,
/// otherwise in windows around the intersections.
class DotReader {
  public:
    DotReader(const Kernels& kernels, const ImageView& image, float spacing_px, MeasuredDots& dots)
        : kernels_(kernels), image_(image), spacing_px_(spacing_px), dots_(dots) {}

    /// Reads the bits of the listed dots. If `block` is not null, adds them to it; it must be
    /// empty.
    BitsRead read(const CellsInView& view, Hypothesis& hypothesis, BitBlock* block);
    /// Reads the bits of the measured dots again, through the new plane of the hypothesis.
    /// Overwrites the block.
    BitsRead read_again(const Hypothesis& hypothesis, BitBlock& block) const;
    /// Improves the centres of the dots. An exact hypothesis is moved to the centres, and the
    /// displacement and residuals in `bits` are updated.
    void find_centres(const CellsInView& view, Hypothesis& hypothesis, bool is_last,
                      BitsRead& bits) const;
    /// If all dots have the same sub-pixel phase, measures the centres again and subtracts the
    /// pixel bias. The plane must be fitted to the current centres before, and again after. Sets
    /// the variance of the mean of the centres that remains, px^2. Returns false if the bias does
    /// not matter: the dots have many phases, or larger errors.
    bool correct_pixel_bias(const CellsInView& view, const Hypothesis& hypothesis,
                            const PoseFit& fit, FloatVec& remaining_px2) const;
    /// Corrects the bias of facing dots if the centroid windows reach the neighbouring dot. The
    /// plane must be fitted again after. Returns false, without a change, if there is no such bias.
    bool correct_neighbour_bias(const Hypothesis& hypothesis, const PoseFit& fit) const;
    const MeasuredDots& dots() const { return dots_; }

  private:
    WindowOptions window_options(const Hypothesis& hypothesis) const;

    const Kernels& kernels_;
    const ImageView& image_;
    const float spacing_px_;
    MeasuredDots& dots_;
    float typical_mass_ = 0;
    float paper_ = 0;  ///< mean paper level around dots; 0 if not known yet
};

}  // namespace dotpose::core
