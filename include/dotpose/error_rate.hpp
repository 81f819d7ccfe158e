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
/// A Locator does the same automatically if `bits_per_error` is kMeasuredErrorRate.
/// docs/integrity.md, "Measured error rate", explains why all frames must be added, including those
/// without a fix.
#pragma once

#include <array>
#include <cstddef>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// The bits of one frame, compared with the code at the most likely position.
struct ComparedBits {
    Cell cell;      ///< cell of the code plane near the middle of the view
    int count = 0;  ///< number of bits, two per dot; 0 if no position was found
    int wrong = 0;  ///< number of these bits that disagree with the code at the position

    /// Returns true if bits were compared, and `other` has more wrong bits or no bits.
    bool agrees_better_than(const ComparedBits& other) const {
        return count > 0 && (other.count == 0 || wrong < other.wrong);
    }
};

/// Measures the rate of misread bits. Frames that may show the same dots are not independent, so
/// they count once, with the largest number of wrong bits in one of them. Each frame is compared
/// with the latest kPlaces places. If a camera returns to an older place, the place counts again.
class ErrorRate {
  public:
    static constexpr std::size_t kPlaces = 32;
    /// Maximum of IntegrityOptions::bits_per_error.
    static constexpr int kMaxBitsPerError = 65536;

    /// Adds a frame. Ignores frames without compared bits, and frames whose counts are not
    /// possible.
    void add(const ComparedBits& frame);

    /// Returns a lower limit of the number of bits per misread bit, with a confidence of at least
    /// 95 %: n / (k + 2 sqrt(k) + 3), rounded down, for n bits of which k are wrong. Does not count
    /// the bits of the place of the last frame, because the next frame may show the same dots, but
    /// counts its wrong bits. The result is in [0, kMaxBitsPerError].
    int bits_per_error() const;

  private:
    void settle(const ComparedBits& place);

    std::array<ComparedBits, kPlaces> places_{};  ///< the latest places
    std::size_t latest_ = 0;                      ///< place of the last frame
    std::size_t oldest_ = 0;                      ///< place that the next new place replaces
    /// Number of bits at all earlier places. If there are more than 2^15, older frames have less
    /// weight.
    int settled_ = 0;
    int settled_wrong_ = 0;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
