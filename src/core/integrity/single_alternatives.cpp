#include "core/integrity/single_alternatives.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// Number of lost bits beyond which an alternative is not evaluated. It contributes the odds at
/// this loss, once for each line. With 16 lines, all these alternatives contribute at most 2^-37.
constexpr int kSkippedBits = 51;
/// In small views, many alternatives lose 44 to 51 bits by the minimum losses of the lines, and
/// evaluating all of them would take too long. An alternative that loses at least this number of
/// bits by the minimum losses is therefore not evaluated, but contributes the odds at this loss.
constexpr int kEvaluatedBits = 43;
/// Estimated cost of evaluating one listed place, in units of `WorkLimit`.
constexpr std::size_t kWorkPerEntry = 68;
/// Estimated cost of counting a place that is not listed, in units of `WorkLimit`.
constexpr std::size_t kWorkPerUnlisted = 12;
/// Estimated cost per line of evaluating all places, in units of `WorkLimit`.
constexpr std::size_t kWorkOfAll = 85'000;

/// Returns the odds of a single alternative at the shift where it shares the line `shared`.
float odds_at(const LossTables& lines, const RollOffsets& offsets, std::size_t shared) {
    // Adding `base` makes the offset in the shared line 126, which is 0 modulo 63, and keeps the
    // other offsets positive.
    const int base = 2 * kSections - offsets[shared];
    int lost = 0;
    for (int line = 0; line < lines.count(); ++line) {
        lost += lines.loss(line, offsets[static_cast<std::size_t>(line)] + base);
        if (lines.ratios.is_hopeless(lost)) return kNegligible;
    }
    return lines.ratios.odds(lost);
}

/// Losses of the single alternatives in one sequence, which are computed line by line.
class LossesInSequence {
  public:
    /// `sorted` contains the lines in the order in which their losses are added up.
    LossesInSequence(const LossTables& lines, std::size_t sequence,
                     std::span<const LineLoss> sorted)
        : rolls_(lines.ratios.basis[sequence].rolls),
          own_(rolls_ + lines.ratios.places[sequence]),
          first_(std::min(sorted.size(), kFirstLines)),
          count_(sorted.size()) {
        for (std::size_t n = 0; n < sorted.size(); ++n) {
            const std::uint8_t line = sorted[n].line;
            // Adding 126, which is 0 modulo 63, keeps the indices positive.
            tables_[n] = {lines.losses(line) + 2 * kSections - own_[line], line};
        }
    }

    /// Returns the loss of the alternative at `place`, at the shift where it shares the line
    /// `shared`. After the first kFirstLines lines, stops as soon as the loss exceeds `max_loss`,
    /// and returns the loss so far.
    int operator()(std::uint32_t place, std::size_t shared, int max_loss) const {
        const std::uint8_t* const alternative = rolls_ + place;
        const std::ptrdiff_t shift = own_[shared] - alternative[shared];
        const auto loss_in = [&](const Table& table) {
            return table.losses[alternative[table.line] + shift];
        };
        int lost = 0;
        for (std::size_t n = 0; n < first_; ++n)
            lost += loss_in(tables_[n]);
        for (std::size_t n = first_; n < count_ && lost <= max_loss; ++n)
            lost += loss_in(tables_[n]);
        return lost;
    }

  private:
    /// Adding the losses in a few more lines is faster than a mispredicted branch.
    static constexpr std::size_t kFirstLines = 8;

    struct Table {
        const std::int16_t* losses;  ///< losses in a line, by roll of the alternative
        std::size_t line;
    };
    const std::uint8_t* rolls_;
    const std::uint8_t* own_;  ///< rolls at the place of the reading
    std::array<Table, kMaxLines> tables_;
    std::size_t first_;  ///< number of lines whose losses are always added up
    std::size_t count_;
};

float sum_one_by_one(const LossTables& lines) {
    const LikelihoodRatios& ratios = lines.ratios;
    float sum = 0;
    RollOffsets offsets;
    for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
        for (std::uint32_t alternative = 0; alternative < ratios.basis[k].length; ++alternative) {
            if (alternative == ratios.places[k]) continue;
            lines.set_offsets(k, alternative, offsets);
            for (auto shared = offsets.begin(); shared < offsets.begin() + lines.count();
                 ++shared) {
                // An alternative may share several lines at the same shift. It is counted once, at
                // the first of these lines.
                if (std::find(offsets.begin(), shared, *shared) != shared) continue;
                sum += odds_at(lines, offsets, static_cast<std::size_t>(shared - offsets.begin()));
            }
        }
    }
    return sum;
}

/// Sets `sorted` to the lines and their losses, in order of decreasing loss.
void sort_losses(const CoarseLosses& losses, std::span<LineLoss> sorted) {
    for (std::size_t line = 0; line < sorted.size(); ++line) {
        std::size_t i = line;
        for (; i > 0 && sorted[i - 1].loss < losses.losses[line]; --i)
            sorted[i] = sorted[i - 1];
        sorted[i] = {static_cast<std::uint8_t>(line), losses.losses[line]};
    }
}

/// Returns an upper bound on the summed odds of the alternatives at places that
/// `Kernels::list_similar_places` neither lists nor counts.
float sum_of_skipped(const LossTables& lines, int skipped_bits) {
    constexpr float kPlaces =
        code::kA1.size() + code::kA2.size() + code::kA3.size() + code::kA4Restored.size();
    return kPlaces * static_cast<float>(lines.count()) * power_of_two_exactly(-skipped_bits);
}

}  // namespace

std::optional<float> sum_of_single_alternatives(const Kernels& kernels, const LossTables& lines,
                                                int extra_bits, WorkLimit& work) {
    const LikelihoodRatios& ratios = lines.ratios;
    const int skipped_bits = kSkippedBits + extra_bits;
    const int evaluated_bits = kEvaluatedBits + extra_bits;
    const CoarseLosses losses(ratios, skipped_bits);
    std::array<LineLoss, kMaxLines> storage;
    const auto sorted = std::span(storage).first(static_cast<std::size_t>(lines.count()));
    sort_losses(losses, sorted);
    SimilarPlaceList list;
    list.max_count = SimilarPlaceList::kMax;
    list.unlisted_limit = losses.loss_for(ratios, evaluated_bits);
    if (!kernels.list_similar_places(ratios.basis, ratios.places, 15, sorted, losses.limit, list)) {
        if (!work.spend(kWorkOfAll * sorted.size())) return {};
        return sum_one_by_one(lines);
    }
    if (!work.spend(kWorkPerEntry * static_cast<std::size_t>(list.count) +
                    kWorkPerUnlisted * static_cast<std::size_t>(list.unlisted_count))) {
        return {};
    }
    // An alternative whose losses in some of the lines add up to more than this limit has odds
    // below 2^-skipped_bits, regardless of its gains in the other lines.
    const int max_loss = ratios.loss_for(-256 * skipped_bits) + ratios.max_gain();
    std::array<int, SimilarPlaceList::kMax> evaluated;  // losses of at most `max_loss`
    std::size_t count = 0;
    auto rest = std::span<const SimilarPlaceList::Entry>(list.places)
                    .first(static_cast<std::size_t>(list.count));
    // The list is sorted by sequence.
    while (!rest.empty()) {
        const std::size_t sequence = rest.front().sequence;
        const LossesInSequence loss_at(lines, sequence, sorted);
        std::size_t n = 0;
        for (; n < rest.size() && rest[n].sequence == sequence; ++n) {
            evaluated[count] = loss_at(rest[n].place, rest[n].line, max_loss);
            count += evaluated[count] <= max_loss ? 1 : 0;
        }
        rest = rest.subspan(n);
    }
    float sum = sum_of_skipped(lines, skipped_bits) +
                static_cast<float>(list.unlisted_count) * power_of_two_exactly(-evaluated_bits) +
                static_cast<float>(list.count - static_cast<int>(count)) *
                    power_of_two_exactly(-skipped_bits);
    for (const int lost : std::span(evaluated).first(count))
        sum += ratios.odds(lost);
    return sum;
}

}  // namespace dotpose::core
