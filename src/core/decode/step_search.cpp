#include "core/decode/step_search.hpp"

#include <algorithm>
#include <array>

#include "code/basis.hpp"
#include "code/rolls.hpp"
#include "core/decode/tuning.hpp"

namespace dotpose::core {
namespace {

constexpr std::size_t kSequences = 4;
constexpr std::size_t kDigits = 3;
constexpr std::size_t kStepSizes = code::kMaxDelta - code::kMinDelta + 1;

/// Losses of a step, indexed by secondary sequence and digit. A loss is the highest score over all
/// step sizes, minus the highest score over the step sizes with this digit.
using StepLosses = std::array<std::array<std::int32_t, kDigits>, kSequences>;

/// Scores of a line by roll, repeated once, so that no index needs to be reduced modulo 63.
using RepeatedScores = std::array<std::int16_t, std::size_t{2} * kSections>;

/// Number of rolls in a sum over all rolls, rounded up to whole vectors. Roll 63 is roll 0 again,
/// which does not change a maximum.
constexpr std::size_t kRolls = kSections + 1;

/// Returns the highest total score of two adjacent lines whose rolls differ by `step`.
int best_agreement(const RepeatedScores& line, const RepeatedScores& next, std::size_t step) {
    std::int16_t best = INT16_MIN;
    for (std::size_t roll = 0; roll < kRolls; ++roll)
        best = std::max(best, static_cast<std::int16_t>(line[roll] + next[roll + step]));
    return best;
}

StepLosses losses_of(const RepeatedScores& line, const RepeatedScores& next) {
    std::array<std::int32_t, kStepSizes> agreements;
    for (std::size_t i = 0; i < kStepSizes; ++i)
        agreements[i] = best_agreement(line, next, i + code::kMinDelta);
    const std::int32_t best = *std::max_element(agreements.begin(), agreements.end());
    StepLosses losses;
    losses.fill({INT32_MAX, INT32_MAX, INT32_MAX});
    for (std::size_t i = 0; i < kStepSizes; ++i) {
        for (std::size_t n = 0; n < kSequences; ++n) {
            std::int32_t& loss = losses[n][code::digit_of_delta(i + code::kMinDelta, n)];
            loss = std::min(loss, best - agreements[i]);
        }
    }
    return losses;
}

constexpr std::size_t kChoices = tuning::step_search::kChoices;
using Choices = std::array<std::uint32_t, kChoices>;

/// Upper bound on the length of a sequence.
constexpr std::size_t kMaxLength = 256;

/// Returns the places with the smallest total losses, in order of increasing loss.
Choices likeliest_places(const code::Secondary& sequence, std::size_t n,
                         std::span<const StepLosses> steps) {
    Choices places{};
    std::array<std::int32_t, kChoices> losses;
    losses.fill(INT32_MAX);
    // Digits from the first place to the last place of the last reading.
    std::array<std::uint8_t, kMaxLength + kMaxLines> digits;
    for (std::uint32_t i = 0; i < sequence.length + steps.size(); ++i)
        digits[i] = i < sequence.length ? sequence.digit(i) : digits[i - sequence.length];
    std::array<std::int32_t, kMaxLength> totals;
    std::fill_n(totals.begin(), sequence.length, 0);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const auto [zero, one, two] = steps[i][n];
        const std::uint8_t* const digit = digits.data() + i;
        for (std::size_t place = 0; place < sequence.length; ++place)
            totals[place] += digit[place] == 0 ? zero : digit[place] == 1 ? one : two;
    }
    for (std::uint32_t first = 0; first < sequence.length; ++first) {
        const std::int32_t loss = totals[first];
        if (loss >= losses.back()) continue;
        std::size_t rank = kChoices - 1;
        for (; rank > 0 && loss < losses[rank - 1]; --rank) {
            losses[rank] = losses[rank - 1];
            places[rank] = places[rank - 1];
        }
        losses[rank] = loss;
        places[rank] = first;
    }
    return places;
}

/// Replaces `best` if the total score at `position` and its best roll is higher.
void evaluate(CodeVariant code, std::span<const RepeatedScores> lines, std::uint32_t position,
              AxisReading& best) {
    std::array<std::uint8_t, kMaxLines> rolls;
    code::follow_rolls(code, position, 0, std::span(rolls).first(lines.size()));
    std::array<std::int32_t, kRolls> sums{};
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::int16_t* const scores = lines[i].data() + rolls[i];
        for (std::size_t roll = 0; roll < kRolls; ++roll)
            sums[roll] += scores[roll];
    }
    std::int32_t score = sums[0];
    for (const std::int32_t sum : sums)
        score = std::max(score, sum);
    if (score <= best.score) return;
    const auto roll = std::find(sums.begin(), sums.end(), score) - sums.begin();
    best = {position, static_cast<std::uint8_t>(roll), score, best.max_possible};
}

}  // namespace

void search_by_steps(CodeVariant code, const Lines& lines, AxisReading& best) {
    std::array<RepeatedScores, kMaxLines> scores_storage;
    const auto scores = std::span(scores_storage).first(lines.all.size());
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const LineScores& once = lines.all[i].scores;
        std::copy(once.begin(), once.end(), scores[i].begin());
        std::copy(once.begin(), once.end(), scores[i].begin() + kSections);
    }
    std::array<StepLosses, kMaxLines - 1> storage;
    const auto steps = std::span(storage).first(scores.size() - 1);
    for (std::size_t i = 0; i < steps.size(); ++i)
        steps[i] = losses_of(scores[i], scores[i + 1]);
    const code::Basis& basis = code::basis(code);
    std::array<Choices, kSequences> choices;
    for (std::size_t n = 0; n < kSequences; ++n)
        choices[n] = likeliest_places(basis[n], n, steps);
    constexpr std::size_t kWays = kChoices * kChoices * kChoices * kChoices;
    for (std::size_t way = 0; way < kWays; ++way) {
        std::array<std::uint32_t, kSequences> places;
        std::size_t rest = way;
        for (std::size_t n = 0; n < kSequences; ++n, rest /= kChoices)
            places[n] = choices[n][rest % kChoices];
        evaluate(code, scores, code::position_at(basis, places), best);
    }
}

}  // namespace dotpose::core
