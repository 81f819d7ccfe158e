#include "core/integrity/near_alternatives.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/integrity/similar_places.hpp"

namespace dotpose::core {
namespace {

/// Number of periods added to a place before a line index is subtracted. The difference is then
/// positive, because kPeriods periods of any sequence contain more than kMaxLines places.
constexpr std::uint32_t kPeriods = kMaxLines / code::kA3.size() + 1;

/// The places in a sequence with the reading's digits in all steps of a run. A run is a group of
/// adjacent lines. Includes the place of the reading.
class TwinPlaces {
  public:
    /// The run has `digits` + 1 lines, from the line `run`.
    TwinPlaces(const RankedLines& lines, std::size_t sequence, std::uint32_t run, int digits) {
        const code::Secondary& a = lines.ratios.basis[sequence];
        const std::uint32_t own = (lines.ratios.places[sequence] + run) % a.length;
        // Lists the place of the reading first, then the later places, then the earlier places.
        for (const bool before : {false, true}) {
            const auto add = [&](std::uint32_t place) {
                if ((place < own) != before) return;
                const std::uint32_t first = (place + kPeriods * a.length - run) % a.length;
                twins_[count_++] = since_run(lines, sequence, first, run);
            };
            for (std::uint32_t word = 0; 32 * word < a.length; ++word)
                visit_places(a.equal_places(own, digits, word), word, add);
        }
    }

    /// A place with its roll offsets.
    struct Twin {
        /// Offsets at the ranks 0 to 7, relative to `at_run`, modulo 63.
        EightOffsets first = 0;
        const RankedLines::Offsets* offsets;
        int at_run;  ///< offset in the first line of the run
    };
    std::span<const Twin> all() const { return std::span(twins_).first(count_); }

  private:
    static Twin since_run(const RankedLines& lines, std::size_t sequence, std::uint32_t place,
                          std::uint32_t run) {
        const RankedLines::Offsets& offsets = lines.offsets(sequence, place);
        Twin twin{0, &offsets, offsets.all[static_cast<std::size_t>(lines.rank(run))]};
        for (int rank = 0; rank < std::min(lines.count(), 8); ++rank) {
            const int more = offsets.all[static_cast<std::size_t>(rank)] - twin.at_run;
            twin.first |= static_cast<EightOffsets>(more < 0 ? more + kSections : more) << 8 * rank;
        }
        return twin;
    }

    std::size_t count_ = 0;
    std::array<Twin, code::kA4Restored.size()> twins_;
};

using OneOfEach = std::array<const TwinPlaces::Twin*, 4>;

/// Returns the odds of an alternative that shares a run. `twins` contains the alternative's place
/// in each sequence. `first` is the sum of `Twin::first` over these places.
float odds_of_twins(const RankedLines& lines, EightOffsets first, const OneOfEach& twins) {
    int lost = lines.loss_of_first(first);
    for (int rank = 8; rank < lines.count() && !lines.ratios.is_hopeless(lost); ++rank) {
        int further = 4 * kSections;
        for (const TwinPlaces::Twin* twin : twins)
            further += twin->offsets->all[static_cast<std::size_t>(rank)] - twin->at_run;
        lost += lines.loss(
            rank,
            static_cast<int>(code::short_modulo_sections(static_cast<std::uint32_t>(further))));
    }
    return lines.ratios.is_hopeless(lost) ? kNegligible : lines.ratios.odds(lost);
}

/// Returns the summed odds of the alternatives that share a whole run.
float sum_of_twins(const RankedLines& lines, const std::array<TwinPlaces, 4>& places) {
    float sum = 0;
    bool is_own = true;  // the first combination is the reading itself
    for (const auto& a : places[0].all()) {
        for (const auto& b : places[1].all()) {
            for (const auto& c : places[2].all()) {
                // No byte overflows, because 4 * 62 = 248.
                const EightOffsets first = a.first + b.first + c.first;
                for (const auto& d : places[3].all()) {
                    if (!is_own) sum += odds_of_twins(lines, first + d.first, {&a, &b, &c, &d});
                    is_own = false;
                }
            }
        }
    }
    return sum;
}

}  // namespace

float sum_of_near_alternatives(const RankedLines& lines, int shared_lines) {
    float sum = 0;
    for (int run = 0; run + shared_lines <= lines.count(); ++run) {
        const auto places = [&](std::size_t k) {
            return TwinPlaces(lines, k, static_cast<std::uint32_t>(run), shared_lines - 1);
        };
        sum += sum_of_twins(lines, {places(0), places(1), places(2), places(3)});
    }
    return sum;
}

}  // namespace dotpose::core
