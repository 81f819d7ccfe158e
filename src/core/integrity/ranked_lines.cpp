#include "core/integrity/ranked_lines.hpp"

#include <numeric>
#include <span>

namespace dotpose::core {

static_assert(code::kA4Restored.size() == code::kA4Published.size() &&
              code::kA4Restored.size() == code::kA4Microdots.size());

RankedLines::RankedLines(const LikelihoodRatios& of) : ratios(of) {
    for (int line = 0; line < count(); ++line) {
        for (int shift = 0; shift < kSections; ++shift) {
            odds_[static_cast<std::size_t>(line)][static_cast<std::size_t>(shift)] =
                ratios.odds(ratios.loss(line, shift));
        }
    }
    rank_lines();
    set_losses();
    set_offsets_of_places();
}

/// Ranks the lines by their summed odds over all nonzero roll offsets. The line with the smallest
/// sum has the most information and gets rank 0.
void RankedLines::rank_lines() {
    std::array<float, kMaxLines> sums;
    for (std::size_t line = 0; line < static_cast<std::size_t>(count()); ++line) {
        const auto others = std::span(odds(static_cast<int>(line))).subspan(1);
        sums[line] = std::accumulate(others.begin(), others.end(), 0.0F);
        // Insertion sort, because `std::sort` would add more machine code than the rest of this
        // file.
        std::size_t rank = line;
        for (; rank > 0 && sums[lines_[rank - 1]] > sums[line]; --rank)
            lines_[rank] = lines_[rank - 1];
        lines_[rank] = static_cast<std::uint8_t>(line);
    }
    for (int n = 0; n < count(); ++n)
        ranks_[lines_[static_cast<std::size_t>(n)]] = static_cast<std::uint8_t>(n);
}

void RankedLines::set_losses() {
    for (int rank = count(); rank < 8; ++rank)
        losses_[static_cast<std::size_t>(rank)].fill(0);
    for (int rank = 0; rank < count(); ++rank) {
        auto& losses = losses_[static_cast<std::size_t>(rank)];
        for (int shift = 0; shift < kSections; ++shift) {
            losses[static_cast<std::size_t>(shift)] =
                static_cast<std::int16_t>(ratios.loss(line(rank), shift));
        }
        for (std::size_t further = kSections; further < losses.size(); ++further)
            losses[further] = losses[further - kSections];
    }
}

void RankedLines::set_offsets_of_places() {
    for (std::size_t k = 0; k < kFirsts.size(); ++k) {
        for (std::uint32_t place = 0; place < ratios.basis[k].length; ++place) {
            RollOffsets by_line;
            set_roll_offsets(ratios, k, place, by_line);
            Offsets& offsets = offsets_[kFirsts[k] + place];
            offsets.first = 0;
            for (int rank = 0; rank < count(); ++rank) {
                const std::uint8_t here = by_line[static_cast<std::size_t>(line(rank))];
                offsets.all[static_cast<std::size_t>(rank)] = here;
                if (rank < 8) offsets.first |= EightOffsets{here} << 8 * rank;
            }
        }
    }
}

}  // namespace dotpose::core
