/// Error rate: the rate of misread bits, measured over the frames of one print and camera.
///
///     ErrorRate rate;
///     for (;;) {
///         options.integrity.bits_per_error = rate.bits_per_error();
///         locator.set_options(options);
///         use(locator.locate(image));
///         rate.add(locator.compared_bits());
///     }
///
/// A Locator does the same by itself if `bits_per_error` is kMeasuredErrorRate. docs/integrity.md,
/// "Measured error rate", explains why all frames must be added, including those without a fix.
#pragma once

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// The bits of one frame, compared with the code at the most likely position.
struct ComparedBits {
    Cell cell;      ///< cell of the code plane near the middle of the view
    int count = 0;  ///< number of bits, two per dot; 0 if no position was found
    int wrong = 0;  ///< number of these bits that disagree with the code at the position
};

/// Measures the rate of misread bits. Frames that may show the same dots are not independent, so
/// they count once, with the largest number of wrong bits in one of them. If more than 2^15 bits
/// have been counted, older frames have less weight.
class ErrorRate {
  public:
    /// Adds a frame. Ignores frames without compared bits.
    void add(const ComparedBits& frame);

    /// Returns a lower limit of the number of bits per misread bit, with a confidence of at least
    /// 95 %: n / (k + 2 sqrt(k) + 3), rounded down, for n bits of which k are wrong. Does not count
    /// the bits of the latest place, because the next frame may show the same dots, but counts its
    /// wrong bits. The result is in [0, 2^15 / 3]. See IntegrityOptions::bits_per_error.
    int bits_per_error() const;

  private:
    ComparedBits here_;  ///< frames at the latest place
    int count_ = 0;      ///< number of bits at all earlier places
    int wrong_ = 0;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
