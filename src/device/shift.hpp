// Shift: finds the error of a prediction from the first rows of a tracked frame.
#pragma once

#include <array>

#include "core/stages.hpp"

namespace dotpose::core {

/// Mean darkness at each possible shift, over the places where the code has dots near the middle
/// column of the image. Dots are displaced, so they agree only with their own places; if few are in
/// view, those one spacing further may look nearly as good.
class Shifts {
  public:
    /// Searches the rows kept by `tracking`.
    explicit Shifts(const Tracking& tracking);

    /// Returns the likeliest shift that was not returned yet; false if there is nothing dark.
    bool next(Vec& shift_q8);

    int paper_level() const { return paper_; }
    /// Returns the darkness of the pixel in the middle of a dot, at the last shift.
    int depth() const { return depth_; }

  private:
    /// Step between sampled pixels, in px: less than half a dot.
    static constexpr int kStep_px = 2;
    /// Greatest number of steps from the middle of the search.
    static constexpr int kMostSteps = 8;
    static constexpr int kMostPerSide = 2 * kMostSteps + 1;
    static constexpr int kPerRow = kMostPerSide + 2;

    void measure_paper(const Tracking& tracking);
    void add_dots(const Tracking& tracking);
    void add_dot(const Tracking& tracking, int u, int v);
    void divide_by_dots();
    /// Returns the sums of a row of steps; the elements before the first and after the last are 0.
    std::uint16_t* row_of(int y) { return sums_.data() + (y + 1) * kPerRow + 1; }
    void forget_around(Vec at);

    int left_ = 0;
    int right_ = 0;
    int rows_ = 0;
    Vec steps_;  ///< number of steps to each side
    int paper_ = 0;
    int cut_ = 0;
    int depth_ = 0;
    std::array<std::uint8_t, kMostPerSide> dots_{};        ///< number of dots summed in each row
    std::array<std::uint16_t, kPerRow * kPerRow> sums_{};  ///< sums of darkness, later means
};

}  // namespace dotpose::core
