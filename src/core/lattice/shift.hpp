// Shift: how far a prediction is off, from the first rows of a tracked frame.
#pragma once

#include <array>

#include "core/stages.hpp"

namespace dotpose::core {

/// Darkness at each shift that comes into question, summed over the places where the code has dots
/// near the middle column of the image. Displaced as they are, dots agree only with their own
/// places; where few are in view, those one spacing on may still look nearly as good.
class Shifts {
  public:
    /// Searches the rows that `tracking` keeps.
    explicit Shifts(const Tracking& tracking);

    /// The likeliest of those that were not shown yet; false where nothing is dark.
    bool next(Vec& shift_q8);

    int paper_level() const { return paper_; }
    /// Darkness of the pixel in the middle of a dot, at the shift shown last.
    int depth() const { return depth_; }

  private:
    /// Pixels are sampled in steps of so much, less than half a dot.
    static constexpr int kStep_px = 2;
    /// Most steps from the middle of the search.
    static constexpr int kMostSteps = 8;
    static constexpr int kMostPerSide = 2 * kMostSteps + 1;
    static constexpr int kPerRow = kMostPerSide + 2;

    void measure_paper(const Tracking& tracking);
    void add_dots(const Tracking& tracking);
    void add_dot(const Tracking& tracking, int u, int v);
    void divide_by_dots();
    /// Of a row of steps; steps before the first and after the last are dark nowhere.
    std::uint16_t* row_of(int y) { return sums_.data() + (y + 1) * kPerRow + 1; }
    void forget_around(Vec at);

    int left_ = 0;
    int right_ = 0;
    int rows_ = 0;
    Vec steps_;  ///< to each side
    int paper_ = 0;
    int cut_ = 0;
    int depth_ = 0;
    std::array<std::uint8_t, kMostPerSide> dots_{};        ///< summed in each row
    std::array<std::uint16_t, kPerRow * kPerRow> sums_{};  ///< and then means
};

}  // namespace dotpose::core
