// Counts the frames in which the second solution for the pose in space is mistaken for the first
// (docs/pose-in-space.md). Prints a table in Markdown, and --update also writes it to the document.
//
//   dotpose_tables space_second [--frames N] [--seed S] [--threads N] [--update DOCUMENT]
//
// The exit status is 1 if a wrong pose is not reported as ambiguous.
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/core.h>

#include "space_view.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

/// The lenses from the `space` table, and lenses with a narrow field of view. With a narrow field
/// of view, perspective hardly distinguishes the two possible poses.
constexpr std::array kSecondLenses = {kSpaceLenses[0], kSpaceLenses[1],
                                      SpaceLens{"10 degrees", 167, -0.03e-6},
                                      SpaceLens{"2 degrees", 838, 0}};

/// A range from which tilts are drawn uniformly.
struct TiltRange {
    double from_deg;
    double to_deg;
};
constexpr std::array kTiltRanges = {TiltRange{0, 15}, TiltRange{15, 30}, TiltRange{30, 45}};

struct SecondTally {
    std::uint64_t frames = 0;
    std::uint64_t located = 0;
    std::uint64_t second = 0;  ///< number of frames with a second pose, even if ruled out
    std::uint64_t ambiguous = 0;
    std::uint64_t swapped = 0;  ///< number of ambiguous frames whose second pose is more accurate
    double expected = 0;        ///< expected value of `swapped`, computed from the odds
    std::uint64_t wrong = 0;    ///< number of wrong poses that are not reported as ambiguous

    void operator+=(const SecondTally& other) {
        frames += other.frames;
        located += other.located;
        second += other.second;
        ambiguous += other.ambiguous;
        swapped += other.swapped;
        expected += other.expected;
        wrong += other.wrong;
    }
};

void count(const Shot& shot, SecondTally& tally) {
    ++tally.frames;
    const SpaceReading reading(shot);
    const auto& pose = reading.pose();
    if (!pose) return;
    ++tally.located;
    tally.second += pose->second ? 1 : 0;
    const TrueSpacePose truth = true_space_pose(shot);
    const SpaceMatrix covariance = matrix_of(pose->covariance);
    const double square = normalised_square(space_error(pose->camera, truth), covariance);
    if (!pose->is_ambiguous()) {
        tally.wrong += square > kMaxNormalisedSquare ? 1 : 0;
        return;
    }
    ++tally.ambiguous;
    const double odds = std::exp2(pose->second->odds_log2);
    tally.expected += odds / (1 + odds);
    const SpaceVector second = space_error(pose->second->camera, truth);
    tally.swapped += normalised_square(second, covariance) < square ? 1 : 0;
}

double tilt_of(const TiltRange& range, std::uint64_t seed, std::uint64_t index) {
    return Rng(seed, index).uniform(range.from_deg, range.to_deg);
}

}  // namespace

bool space_second_table(TableRun& run) {
    std::uint64_t frames = 20'000;
    run.add_count("--frames", frames, "Number of frames of all rows together");
    run.add_seed();
    run.add_threads();
    run.add_update();
    if (!run.parse()) return true;
    constexpr std::uint64_t kRows = kSecondLenses.size() * kTiltRanges.size();
    std::string text =
        "| field | tilt | located | with a second pose | ambiguous | of these, the second is right "
        "| expected from the odds | wrong, not ambiguous |\n"
        "|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    bool is_right = true;
    std::uint64_t row = 0;  // each row uses different frames
    for (const SpaceLens& lens : kSecondLenses) {
        for (const TiltRange& range : kTiltRanges) {
            const std::uint64_t seed = scramble(run.seed + 1000 + row++);
            const std::string what =
                fmt::format("{}, tilt {} to {}", lens.title, range.from_deg, range.to_deg);
            const auto result = run.count<SecondTally>(
                what, (frames + kRows - 1) / kRows, [&](std::uint64_t i, SecondTally& tally) {
                    count(space_shot(lens, tilt_of(range, seed, i), seed, i), tally);
                });
            const SecondTally& t = result.tally;
            text += fmt::format("| {} | {} to {} | {} of {} | {} | {} | {} | {:.1f} | {} |\n",
                                lens.title, range.from_deg, range.to_deg, t.located, t.frames,
                                t.second, t.ambiguous, t.swapped, t.expected, t.wrong);
            is_right &= t.wrong == 0 && result.is_complete();
        }
    }
    run.print_block("space second", text);
    run.update_document();
    return is_right;
}

}  // namespace dotpose::tables
