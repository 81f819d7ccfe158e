// Work limit: the computation budget of an attempt.
#pragma once

#include <cstddef>

namespace dotpose::core {

/// Remaining computation budget of an attempt. The unit is the mean time of a processor
/// instruction. A mispredicted branch costs about 50 units.
class WorkLimit {
  public:
    /// Budget of one attempt for the sums of the odds of alternatives, for the search for a line
    /// that divides the sheet, and for `Attempts::shows_turn`. All places tested in the attempt
    /// share this budget. First and tracked attempts in images of at most 96 x 96 px have the
    /// budget kOfSmallImage. For comparison, all other steps of a first attempt in such an image
    /// together take 100,000 to 240,000 units. docs/speed.md, "Small frames", compares
    /// several budgets.
    static constexpr std::size_t kOfSmallImage = 430'000;
    static constexpr std::size_t kOfImage = 16'000'000;

    explicit WorkLimit(std::size_t work) : left_(work) {}
    /// Subtracts `work` from the budget and returns true. If less than `work` is left, sets the
    /// budget to 0 and returns false.
    bool spend(std::size_t work) {
        const bool is_enough = work <= left_;
        left_ = is_enough ? left_ - work : 0;
        return is_enough;
    }
    /// Adds work that was spent, but not done.
    void refund(std::size_t work) { left_ += work; }

    std::size_t left() const { return left_; }

  private:
    std::size_t left_;
};

}  // namespace dotpose::core
