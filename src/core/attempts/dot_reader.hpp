// Dot reader: the bits and the centres of dots that are listed, as well as the hypothesis is known.
#pragma once

#include "core/attempts/confirm.hpp"
#include "core/decode/bit_lines.hpp"

namespace dotpose::core {

/// Whether dots that are where they are thought to be can be read at one look, by quick bells.
bool suits_one_pass(const Hypothesis& hypothesis);

/// Reads the dots listed, and measures them: exactly where they are, if that is known, or around
/// the intersections.
class DotReader {
  public:
    DotReader(const Kernels& kernels, const ImageView& image, float spacing_px, MeasuredDots& dots)
        : kernels_(kernels), image_(image), spacing_px_(spacing_px), dots_(dots) {}

    /// Learns how dark dots are, from a few all over the view.
    void sample_some(CellsInView view, Hypothesis& hypothesis);
    /// Adds what it reads to an empty block, unless that is null.
    BitsRead read(const CellsInView& view, Hypothesis& hypothesis, BitBlock* block);
    /// Through another plane.
    BitsRead read_again(const Hypothesis& hypothesis, BitBlock& block) const;
    /// Of an exact hypothesis, also how far dots are displaced and off.
    void find_centres(const CellsInView& view, const Hypothesis& hypothesis, bool is_last,
                      BitsRead& bits) const;

  private:
    WindowOptions window_options(const Hypothesis& hypothesis) const;

    const Kernels& kernels_;
    const ImageView& image_;
    const float spacing_px_;
    MeasuredDots& dots_;
    float typical_mass_ = 0;
    float paper_ = 0;  ///< the mean level around dots, once it is known
};

}  // namespace dotpose::core
