// Work limit: the computation budget for summing the odds of alternatives.
#pragma once

#include <cstddef>

namespace dotpose::core {

/// Remaining computation budget, in estimated processor instructions.
class WorkLimit {
  public:
    /// Budget for summing the odds of alternatives in one frame with a small view. All places
    /// tested in the frame share this budget. For comparison, all other steps of a first attempt
    /// together take 100,000 to 240,000 instructions. docs/speed.md, "Small frames", compares
    /// several budgets.
    static constexpr std::size_t kOfFrame = 460'000;

    explicit WorkLimit(std::size_t work) : left_(work) {}
    /// Subtracts `work` from the budget and returns true. If less than `work` is left, sets the
    /// budget to 0 and returns false.
    bool spend(std::size_t work) {
        const bool is_enough = work <= left_;
        left_ = is_enough ? left_ - work : 0;
        return is_enough;
    }

    std::size_t left() const { return left_; }

  private:
    std::size_t left_;
};

}  // namespace dotpose::core
