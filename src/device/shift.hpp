// Shift: uses the first rows of a tracked frame to measure the error of the predicted position.
#pragma once

#include <array>

#include "device/tracking.hpp"

namespace dotpose::core {

/// For each shift in the search range, the mean darkness of the image at the predicted dot centres,
/// moved by the shift. Only dots near the middle column of the image are used. The mean is largest
/// at the correct shift, because all moved centres then coincide with dots. If few dots are in
/// view, the mean may be nearly as large at a shift that is wrong by one spacing.
class Shifts {
  public:
    /// Measures the darkness in the first rows of the frame, which must be stored in `tracking`.
    explicit Shifts(const Tracking& tracking);

    /// Finds the shift with the largest mean darkness. Ignores shifts that, along both axes, are
    /// within two steps of an earlier result. Sets `shift_q8` to this shift (the vector from the
    /// predicted to the measured position, in 2^-8 px), and returns true. Returns false if the
    /// darkness of all remaining shifts is 0.
    bool next(FixedVec& shift_q8);

    int paper_level() const { return paper_; }
    /// Returns the contrast between the paper and the centres of the dots, in grey levels, at the
    /// shift that `next` returned most recently.
    int depth() const { return depth_; }

  private:
    /// Distance between tested shifts, in px. It is less than half the diameter of a dot.
    static constexpr int kStep_px = 2;
    /// Maximum number of steps in each direction from the middle of the search range.
    static constexpr int kMaxSteps = 8;
    static constexpr int kMaxPerSide = 2 * kMaxSteps + 1;
    static constexpr int kPerRow = kMaxPerSide + 2;

    void measure_paper(const Tracking& tracking);
    void add_dots(const Tracking& tracking);
    void add_dot(const Tracking& tracking, int u, int v);
    void divide_by_dots();
    /// Returns a pointer to the first sum in row `y` of the search range. The elements before and
    /// after the sums of a row are 0.
    std::uint16_t* row_of(int y) { return sums_.data() + (y + 1) * kPerRow + 1; }
    void forget_around(FixedVec at);

    int left_ = 0;
    int right_ = 0;
    int rows_ = 0;
    FixedVec steps_;  ///< number of steps from the middle of the search range to its edge, per axis
    int paper_ = 0;
    int cut_ = 0;
    int depth_ = 0;
    /// Number of dots in the sums of each row of the search range.
    std::array<std::uint8_t, kMaxPerSide> dots_{};
    /// Sums of darkness, which `divide_by_dots` turns into means.
    std::array<std::uint16_t, kPerRow * kPerRow> sums_{};
};

}  // namespace dotpose::core
