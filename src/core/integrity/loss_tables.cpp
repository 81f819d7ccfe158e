#include "core/integrity/loss_tables.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>

namespace dotpose::core {

static_assert(code::kA4Restored.size() == code::kA4Published.size() &&
              code::kA4Restored.size() == code::kA4Microdots.size());

namespace {

/// Converts losses to odds. Caches the results, because the losses of hard bits take only a few
/// distinct values.
class OddsByLoss {
  public:
    explicit OddsByLoss(const LikelihoodRatios& ratios) : ratios_(ratios) { losses_.fill(kNone); }
    float operator()(int loss) {
        // Losses of hard bits are multiples of 254. 64 consecutive multiples map to different
        // slots, because 127 is odd.
        const auto slot = static_cast<std::size_t>(loss >> 1) % losses_.size();
        if (losses_[slot] != loss) {
            losses_[slot] = loss;
            odds_[slot] = ratios_.odds(loss);
        }
        return odds_[slot];
    }

  private:
    static constexpr int kNone = std::numeric_limits<int>::max();

    const LikelihoodRatios& ratios_;
    std::array<int, 64> losses_;
    std::array<float, 64> odds_;
};

}  // namespace

LossTables::LossTables(const LikelihoodRatios& of) : ratios(of) {
    OddsByLoss odds_of(ratios);
    for (std::size_t line = 0; line < static_cast<std::size_t>(count()); ++line) {
        auto& losses = losses_[line];
        const LineScores& scores = ratios.lines[static_cast<int>(line)];
        const auto own = static_cast<std::size_t>(ratios.own_roll(static_cast<int>(line)));
        // Two loops without a branch, so that compilers can vectorise them.
        const std::int16_t own_score = scores[own];
        for (std::size_t roll = own; roll < kSections; ++roll)
            losses[roll - own] = static_cast<std::int16_t>(own_score - scores[roll]);
        for (std::size_t roll = 0; roll < own; ++roll)
            losses[roll + kSections - own] = static_cast<std::int16_t>(own_score - scores[roll]);
        odds_of_others_[line] = 0;
        for (std::size_t offset = 1; offset < kSections; ++offset)
            odds_of_others_[line] += odds_of(losses[offset]);
        for (std::size_t n = kSections; n < losses.size(); n += kSections) {
            const auto end = losses.begin() +
                             std::min<std::ptrdiff_t>(
                                 kSections, std::ssize(losses) - static_cast<std::ptrdiff_t>(n));
            std::copy(losses.begin(), end, losses.begin() + static_cast<std::ptrdiff_t>(n));
        }
    }
}

void LossTables::set_offsets(std::size_t sequence, std::uint32_t place,
                             RollOffsets& offsets) const {
    using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
    // The loop also accesses elements beyond the last line, up to a multiple of the vector size.
    // The roll tables and the array of offsets are large enough for these elements.
    static_assert(kMaxLines % sizeof(Bytes) == 0 && kMaxLines <= code::kLinesAhead);
    const std::uint8_t* const rolls = ratios.basis[sequence].rolls;
    for (std::size_t line = 0; line < static_cast<std::size_t>(count()); line += sizeof(Bytes)) {
        Bytes own;
        Bytes alternative;
        std::memcpy(&own, rolls + ratios.places[sequence] + line, sizeof own);
        std::memcpy(&alternative, rolls + place + line, sizeof alternative);
        const Bytes offset =
            alternative - own + (static_cast<Bytes>(alternative < own) & kSections);
        std::memcpy(offsets.data() + line, &offset, sizeof offset);
    }
}

CoarseLosses::CoarseLosses(const LikelihoodRatios& ratios, int skipped_bits) {
    constexpr int kMaxLimit = 200;
    unit = (ratios.loss_for(-skipped_bits * 256) + ratios.max_gain()) / kMaxLimit + 1;
    limit = loss_for(ratios, skipped_bits);
    for (int line = 0; line < ratios.count(); ++line) {
        losses[static_cast<std::size_t>(line)] =
            static_cast<std::uint8_t>(std::min(std::max(ratios.min_loss(line), 0) / unit, limit));
    }
}

}  // namespace dotpose::core
