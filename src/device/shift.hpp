// Shift: measures the position error of a prediction, from the first rows of a tracked frame.
#pragma once

#include <array>

#include "device/tracking.hpp"

namespace dotpose::core {

/// Mean darkness of the pixels at the predicted dots near the middle column of the image, for each
/// possible shift. At the correct shift, all displaced dots are at their predicted places, so the
/// mean darkness is largest. If few dots are in view, the mean darkness may be nearly as large at
/// shifts that differ from the correct shift by one spacing.
class Shifts {
  public:
    /// Measures the darkness in the first rows of the frame. These rows must be stored in
    /// `tracking`.
    explicit Shifts(const Tracking& tracking);

    /// Sets `shift_q8` to the shift with the largest mean darkness, and returns true. Excludes
    /// shifts within two steps of an earlier result along both axes. Returns false if no shift is
    /// left.
    bool next(FixedVec& shift_q8);

    int paper_level() const { return paper_; }
    /// Returns the contrast between the paper and the middle of a dot, in grey levels, at the most
    /// recently returned shift.
    int depth() const { return depth_; }

  private:
    /// Maximum number of steps from the middle of the search range.
    static constexpr int kMaxSteps = 8;
    static constexpr int kMaxPerSide = 2 * kMaxSteps + 1;
    static constexpr int kPerRow = kMaxPerSide + 2;

    void measure_paper(const Tracking& tracking);
    void add_dots(const Tracking& tracking);
    void add_dot(const Tracking& tracking, int u, int v);
    void divide_by_dots();
    /// Returns the sums of a row of steps. The elements before the first step and after the last
    /// step are 0.
    std::uint16_t* row_of(int y) { return sums_.data() + (y + 1) * kPerRow + 1; }
    void forget_around(FixedVec at);

    int step_px_ = 0;  ///< step between sampled pixels: less than half a dot
    int left_ = 0;
    int right_ = 0;
    int rows_ = 0;
    FixedVec steps_;  ///< number of steps in each direction, along u and v
    int paper_ = 0;
    int cut_ = 0;
    int depth_ = 0;
    std::array<std::uint8_t, kMaxPerSide> dots_{};  ///< number of dots summed in each row of steps
    /// Sums of darkness. Contains means after `divide_by_dots`.
    std::array<std::uint16_t, kPerRow * kPerRow> sums_{};
};

}  // namespace dotpose::core
