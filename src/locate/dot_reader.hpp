// Dot reader: reads the bits and measures the centres of listed dots, in the way that suits how
// well the hypothesis is known.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/pose/refine_pose.hpp"
#include "locate/confirm.hpp"

namespace dotpose::core {

/// Whether dots that are where they are predicted can be read in one look each, by quick bells.
bool suits_one_pass(const Hypothesis& hypothesis);

/// Whether all dots in view fall on the pixels alike, so that what their centres are off does not
/// average out, and are so exact otherwise that this counts. `variance_px2` is that of the mean of
/// their centres along one axis, `side_px` the longer side of the image.
bool may_be_biased(const FloatPlane& plane, float variance_px2, int side_px);

/// Reads and measures the listed dots: exactly at their places, if these are known, otherwise in
/// windows around the intersections.
class DotReader {
  public:
    DotReader(const Kernels& kernels, const ImageView& image, float spacing_px, MeasuredDots& dots)
        : kernels_(kernels), image_(image), spacing_px_(spacing_px), dots_(dots) {}

    /// Reads the bits of the dots listed, and adds them to an empty block unless it is null.
    BitsRead read(const CellsInView& view, Hypothesis& hypothesis, BitBlock* block);
    /// Reads the bits of the measured dots again, through the hypothesis's new plane.
    BitsRead read_again(const Hypothesis& hypothesis, BitBlock& block) const;
    /// Improves the centres of the dots. An exact hypothesis is moved to these, and the
    /// displacement and residuals in `bits` updated.
    void find_centres(const CellsInView& view, Hypothesis& hypothesis, bool is_last,
                      BitsRead& bits) const;
    /// Where all dots fall on the pixels alike, finds the centres once more and takes the bias from
    /// them; the plane must be fitted to the centres so far, and then once more. Sets the variance
    /// that is left of the mean of the centres, px^2. Returns false if there is no bias that
    /// counts: dots fall on the pixels in many ways, or are off by more.
    bool take_bias(const CellsInView& view, const Hypothesis& hypothesis, const PoseFit& fit,
                   FloatVec& left_px2) const;
    /// Moves dots apart that face each other and are so large and near that they draw each other's
    /// centres together; then the plane must be fitted once more. Returns false if there are none.
    bool take_pull(const Hypothesis& hypothesis, const PoseFit& fit) const;
    const MeasuredDots& dots() const { return dots_; }

  private:
    WindowOptions window_options(const Hypothesis& hypothesis) const;

    const Kernels& kernels_;
    const ImageView& image_;
    const float spacing_px_;
    MeasuredDots& dots_;
    float typical_mass_ = 0;
    float paper_ = 0;  ///< mean level around dots; 0: not known yet
};

}  // namespace dotpose::core
