// Ranked lines: what the lines of a contest say, those that say most first, so that most rivals are
// found hopeless after a few of them; and the growth of all places of the secondary sequences, in
// this order.
#pragma once

#include "core/integrity/contest.hpp"

namespace dotpose::core {

/// Growth in each of the first eight lines, a byte for each, the first the lowest.
using EightGrowths = std::uint64_t;

inline constexpr EightGrowths kInEach = 0x0101010101010101;

class RankedLines {
  public:
    explicit RankedLines(const Contest& contest);

    /// The growth of one place, by rank, each less than 63.
    struct Grown {
        EightGrowths first;
        Growth all;
    };

    int count() const { return contest.lines.count(); }
    int line(int rank) const { return lines_[static_cast<std::size_t>(rank)]; }
    int rank(std::uint32_t line) const { return ranks_[line]; }
    /// Odds of each shift in a line; by line, not by rank.
    const std::array<float, kSections>& odds(int line) const {
        return odds_[static_cast<std::size_t>(line)];
    }
    const Grown& grown(std::size_t sequence, std::uint32_t place) const {
        return grown_[kFirsts[sequence] + place];
    }
    /// What a rival loses whose roll is so much further, modulo 63; from 0 to 255.
    int loss(int rank, int further) const {
        return losses_[static_cast<std::size_t>(rank)][static_cast<std::size_t>(further)];
    }
    /// The same of eight growths in the first eight lines: when it gets hopeless, or in all.
    int loss_of_first(EightGrowths further) const {
        const int lost = loss_of_four(0, further);
        return contest.is_hopeless(lost) ? lost : lost + loss_of_four(4, further >> 32);
    }

    const Contest& contest;

  private:
    static constexpr std::array<std::size_t, 4> kFirsts{
        0, code::kA1.size(), code::kA1.size() + code::kA2.size(),
        code::kA1.size() + code::kA2.size() + code::kA3.size()};
    static constexpr std::size_t kPlaces = kFirsts[3] + code::kA4Restored.size();

    int loss_of_four(int rank, EightGrowths further) const {
        int lost = 0;
        for (int n = 0; n < 4; ++n, further >>= 8)
            lost += loss(rank + n, static_cast<int>(further & 255));
        return lost;
    }
    void rank_lines();
    void look_up_losses();
    void grow_places();

    std::array<std::uint8_t, kMaxLines> lines_{};
    std::array<std::uint8_t, kMaxLines> ranks_{};
    std::array<std::array<float, kSections>, kMaxLines> odds_;
    /// Of ranks without a line, up to the eighth: 0.
    std::array<std::array<std::int16_t, 256>, kMaxLines> losses_;
    std::array<Grown, kPlaces> grown_;
};

}  // namespace dotpose::core
