// Dot reader: reads the bits and measures the centres of the listed dots. Samples the dots directly
// if the hypothesis is exact, and uses windows otherwise.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/pose/refine_pose.hpp"
#include "locate/hypothesis.hpp"

namespace dotpose::core {

/// Returns true if the dots of a predicted hypothesis can be sampled directly. Direct sampling
/// takes one sample at each of the four possible dot positions of a cell, and measures centres in
/// small centroid windows.
bool can_sample_directly(const Hypothesis& hypothesis);

/// Returns true if the pixel bias is significant. This is the case if all dots of a row or column
/// have nearly the same sub-pixel phase, and other errors are small. `variance_px2` is the variance
/// of the mean dot centre along one axis. `side_px` is the longer image side.
bool may_be_biased(const FloatPlane& plane, float variance_px2, int side_px);

/// Reads and measures the listed dots. If the hypothesis is exact, samples the four possible dot
/// positions of each cell. Otherwise, uses windows around the intersections.
class DotReader {
  public:
    DotReader(const Kernels& kernels, const ImageView& image, float spacing_px, MeasuredDots& dots)
        : kernels_(kernels), image_(image), spacing_px_(spacing_px), dots_(dots) {}

    /// Reads the bits of the listed dots. If `block` is not null, it must be empty and receives the
    /// bits. If the hypothesis is not exact, sets its `typical_mass`.
    BitsRead read(const CellsInView& view, Hypothesis& hypothesis, BitBlock* block);
    /// Reads the bits of the measured dots again, with the new plane of the hypothesis. Overwrites
    /// `block`.
    BitsRead read_again(const Hypothesis& hypothesis, BitBlock& block) const;
    /// Drops the measured dots that are cut off by the image border, because their centroids are
    /// biased.
    void drop_cut_dots(const Hypothesis& hypothesis) const;
    /// Measures the dot centres in centroid windows. If the hypothesis is exact, also fits its
    /// plane to the centres, and sets `projected`, `squares` and `right` in `bits`. `right` is then
    /// the number of dots found. If fewer than kMinFound dots are found, only sets `right` to 0. If
    /// the hypothesis is not exact, measures the centres only if `is_last` is true.
    void find_centres(const CellsInView& view, Hypothesis& hypothesis, bool is_last,
                      BitsRead& bits) const;
    /// Measures the centres again and subtracts the pixel bias if the bias is significant (see
    /// `may_be_biased`). The plane must have been fitted to the current centres, and must be fitted
    /// again to the corrected centres. Sets `remaining_px2` to the variance of the mean dot centre
    /// due to the remaining bias. Returns false and changes nothing if the bias is not significant,
    /// if the hypothesis is exact, or if the lens has distortion.
    bool correct_pixel_bias(const CellsInView& view, const Hypothesis& hypothesis,
                            const PoseFit& fit, FloatVec& remaining_px2) const;
    /// Corrects the bias caused by facing dots, which are adjacent dots displaced towards each
    /// other (see core/pose/facing_dots.hpp). The plane must be fitted again afterwards. Returns
    /// false and changes nothing if the hypothesis is exact, if the centroid windows do not extend
    /// to the facing dot, or if the bias is not significant.
    bool correct_neighbour_bias(const Hypothesis& hypothesis, const PoseFit& fit) const;
    const MeasuredDots& dots() const { return dots_; }

  private:
    WindowOptions window_options(const Hypothesis& hypothesis) const;

    const Kernels& kernels_;
    const ImageView& image_;
    const float spacing_px_;
    MeasuredDots& dots_;
    float typical_mass_ = 0;
    float paper_ = 0;  ///< mean paper level around dots, or 0 if unknown
};

}  // namespace dotpose::core
