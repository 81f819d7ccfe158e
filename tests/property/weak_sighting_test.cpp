// Tests the bound that the tracker uses to accept weak measurements (docs/tracking.md). Enumerates
// all other places inside the tracker's gate, sums their odds relative to the true place, and
// compares the sum with the bound.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "core/decode/position.hpp"
#include "core/decode/window.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose {
namespace {

constexpr int kMaxSide = 16;
/// Maximum distance per axis, in cells, between two places inside the tracker's gate. The gate
/// extends less than 15 cells to each side, so the distance is less than 30.
constexpr int kReach = 29;
constexpr std::uint64_t kSeed = 20;
constexpr std::array kCodeVariants{CodeVariant::anoto, CodeVariant::libdots,
                                   CodeVariant::microdots};

/// The bits that were read in a rectangle of the pattern. The pattern is upright in the image.
struct View {
    CodeVariant code = CodeVariant::anoto;
    Place place;
    int columns = 0;
    int rows = 0;
    double odds_log2 = 0;  ///< log2 of the odds that a bit with full weight is correct
    std::array<GridCell, kMaxSide * kMaxSide> cells{};

    core::Grid grid() {
        core::Grid grid;
        grid.storage = cells;
        grid.side = kMaxSide;
        grid.columns = columns;
        grid.rows = rows;
        return grid;
    }
};

/// Sets a random size and a random noise level, and fills the cells of the view with noisy bits of
/// the code.
void read(View& view, Rng& rng) {
    view.columns = 8 + static_cast<int>(rng.below(5));
    view.rows = 8 + static_cast<int>(rng.below(5));
    view.odds_log2 = rng.uniform(1.5, 6);
    const double missing = rng.below(2) == 0 ? 0 : rng.uniform(0, 0.25);
    const unsigned min_weight = rng.below(2) == 0 ? 127 : 8;
    const auto bit = [&](int truth) {
        const int weight = static_cast<int>(min_weight + rng.below(127 - min_weight + 1));
        const bool is_wrong = rng.uniform() < 1 / (1 + std::exp2(view.odds_log2 * weight / 127));
        return static_cast<std::int8_t>((truth == 1) != is_wrong ? weight : -weight);
    };
    core::Grid grid = view.grid();
    for (int j = 0; j < view.rows; ++j) {
        for (int i = 0; i < view.columns; ++i) {
            grid.at(i, j) = {};
            if (rng.uniform() < missing) continue;
            const Place at = moved(view.code, view.place, i, j);
            const Symbol symbol = symbol_at(view.code, at.cell, at.section);
            grid.at(i, j) = {bit(x_bit(symbol)), bit(y_bit(symbol)), 0};
        }
    }
}

/// Decodes the view. Returns log2 of the p_wrong that the decoder reports, or 1 if the decoder
/// finds no place or a wrong place.
int claim(View& view) {
    core::Grid grid = view.grid();
    Decoding decoding;
    decoding.window = core::choose_window(grid, kWindowSide);
    decoding.region = core::choose_window(grid, kMaxSide);
    std::array<core::ScoredLine, 2 * kMaxSide> storage;
    Fix fix;
    if (core::decode_all(grid, view.code, storage, decoding) != Status::ok) return 1;
    const IntegrityOptions all{0, 256};
    core::WorkLimit work(core::WorkLimit::kOfImage);
    if (core::verify(core::kernels(), grid, view.code, nullptr, all, storage, work, decoding,
                     fix) != Status::ok)
        return 1;
    return decoding.place == view.place && decoding.pattern_from_grid.quarters == 0
               ? fix.p_wrong_log2
               : 1;
}

/// Returns the main-sequence index of the first cell in view, for each line from `first` - kReach
/// to `first` + kReach + kMaxSide - 1.
std::vector<int> starts(CodeVariant code, std::uint32_t first, int section, std::uint32_t cross) {
    std::vector<int> result;
    for (int i = -kReach; i < kReach + kMaxSide; ++i) {
        const auto position = static_cast<std::uint32_t>(static_cast<int>(first) + i);
        result.push_back(roll(code, position) + section + static_cast<int>(cross % kSections));
    }
    return result;
}

/// Returns an array whose element k is the sum of the odds of all other places that are at most k
/// cells away along both axes. The odds of a place are relative to the true place, and are the
/// product of the odds of all bits.
std::array<double, kReach + 1> odds_by_distance(View& view) {
    const auto& [cell, section] = view.place;
    const auto columns = starts(view.code, cell.x, section.u, cell.y);
    const auto rows = starts(view.code, cell.y, section.v, cell.x);
    const auto main = [](int index) {
        return main_bit(static_cast<std::uint32_t>(index + kSections));
    };
    // Returns the score of a line whose first cell is at index `start` of the main sequence. The
    // score is the sum of the weights of the bits that agree with the sequence, minus the sum of
    // the weights of the bits that disagree.
    const core::Grid grid = view.grid();
    const auto score = [&](bool is_x, int line, int start) {
        int sum = 0;
        for (int k = 0; k < (is_x ? view.rows : view.columns); ++k) {
            const int weight = is_x ? grid.at(line, k).x : grid.at(k, line).y;
            sum += main(start + k) == 1 ? weight : -weight;
        }
        return sum;
    };
    const auto total = [&](int dx, int dy) {
        int sum = 0;
        for (int i = 0; i < view.columns; ++i)
            sum += score(true, i, columns[static_cast<std::size_t>(kReach + dx + i)] + dy);
        for (int j = 0; j < view.rows; ++j)
            sum += score(false, j, rows[static_cast<std::size_t>(kReach + dy + j)] + dx);
        return sum;
    };
    const int of_truth = total(0, 0);
    std::array<double, kReach + 1> sums{};
    for (int dy = -kReach; dy <= kReach; ++dy) {
        for (int dx = -kReach; dx <= kReach; ++dx) {
            if (dx == 0 && dy == 0) continue;
            // The difference is halved, because each bit in which the places differ is added to one
            // score and subtracted from the other.
            const double odds = std::exp2(view.odds_log2 / 127 * (total(dx, dy) - of_truth) / 2);
            for (int k = std::max(std::abs(dx), std::abs(dy)); k <= kReach; ++k)
                sums[static_cast<std::size_t>(k)] += odds;
        }
    }
    return sums;
}

/// Draws views of a place until the p_wrong of one view is between 2^-30 and 2^-10. For this view,
/// computes the margin of the tracker's bound at each gate size, and returns the minimum. The
/// margin is log2 of the ratio of the bound to the sum of the odds in the gate.
double margin_of_weak_view(CodeVariant code, const Place& place, Rng& rng) {
    View view;
    view.code = code;
    view.place = place;
    int p_wrong_log2 = 1;
    while (p_wrong_log2 > -10 || p_wrong_log2 <= -30) {
        read(view, rng);
        p_wrong_log2 = claim(view);
    }
    const auto sums = odds_by_distance(view);
    double least = 1e9;
    for (unsigned k = 1; k <= kReach; ++k) {
        // If two places inside a gate are k cells apart, the tracker counts at least k + 2 cells in
        // the gate.
        const int cells_log2 = std::bit_width(k + 1);
        least = std::min(least, p_wrong_log2 + cells_log2 - 36 - std::log2(sums[k]));
    }
    return least;
}

TEST(WeakSighting, NoPlaceInTheGateIsLikelierThanTheBound) {
    for (const CodeVariant code : kCodeVariants) {
        for (std::uint64_t i = 0; i < 15; ++i) {
            Rng rng(kSeed, i);
            const auto position = [&] { return 40 + rng.below(kPositionsPerAxis - 100); };
            const auto section = [&] { return static_cast<std::uint8_t>(rng.below(kSections)); };
            const Place place = {{position(), position()}, {section(), section()}};
            EXPECT_GT(margin_of_weak_view(code, place, rng), 100)
                << "view " << i << ", seed " << kSeed;
        }
    }
}

/// Five consecutive lines that are repeated `distance` lines later, with `roll` added to the roll
/// of each line.
struct Repetition {
    std::uint32_t position = 0;
    int distance = 0;  ///< in lines
    int roll = 0;      ///< roll of the later lines relative to the earlier lines, 0 to 62
};

/// Returns all repetitions at a distance of at most kReach lines. Five lines are repeated if the
/// digits at the four steps between them are repeated in all four sequences.
std::vector<Repetition> repetitions(CodeVariant code) {
    const code::Basis& basis = code::basis(code);
    std::vector<Repetition> found;
    for (unsigned distance = 1; distance <= kReach; ++distance) {
        std::array<std::vector<std::uint32_t>, 4> places;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto digit = [&](unsigned at) { return basis[k].digit(at % basis[k].length); };
            for (unsigned place = 0; place < basis[k].length; ++place) {
                bool is_same = true;
                for (unsigned i = place; i < place + 4; ++i)
                    is_same = is_same && digit(i) == digit(i + distance);
                if (is_same) places[k].push_back(place);
            }
        }
        for (const std::uint32_t a : places[0]) {
            for (const std::uint32_t b : places[1]) {
                for (const std::uint32_t c : places[2]) {
                    for (const std::uint32_t d : places[3]) {
                        const std::uint32_t at = position_at(basis, {a, b, c, d});
                        if (at < 100 || at > kPositionsPerAxis - 100) continue;
                        const int turn = roll(code, at + distance) - roll(code, at);
                        found.push_back(
                            {at, static_cast<int>(distance), (turn + kSections) % kSections});
                    }
                }
            }
        }
    }
    return found;
}

/// A place, and the offset (dx, dy) of another place with the same 5 x 5 symbols. The offset is at
/// most kReach cells along each axis.
struct Twin {
    Place place;
    int dx = 0;
    int dy = 0;
};

/// Returns all twins. A twin exists if five lines of one axis are repeated and the difference of
/// their rolls cancels the offset along the other axis.
std::vector<Twin> twins(CodeVariant code) {
    const auto found = repetitions(code);
    std::vector<Twin> twins;
    for (const Repetition& x : found) {
        for (const Repetition& y : found) {
            if ((x.roll + y.distance) % kSections == 0 && (y.roll + x.distance) % kSections == 0) {
                twins.push_back({{{x.position, y.position}, {0, 0}}, x.distance, y.distance});
            }
            if (x.roll == y.distance && y.roll == x.distance) {
                const auto further = y.position + static_cast<std::uint32_t>(y.distance);
                twins.push_back({{{x.position, further}, {0, 0}}, x.distance, -y.distance});
            }
        }
    }
    return twins;
}

TEST(WeakSighting, NotEvenWhereThePatternNearlyRepeatsItself) {
    for (const CodeVariant code : kCodeVariants) {
        const auto all = twins(code);
        ASSERT_FALSE(all.empty());
        for (std::uint64_t i = 0; i < 15; ++i) {
            Rng rng(kSeed, i);
            const auto& [place, dx, dy] = all[rng.below(static_cast<std::uint32_t>(all.size()))];
            for (int k = 0; k < 25; ++k) {
                const Place here = moved(code, place, k % 5, k / 5);
                const Place there = moved(code, place, dx + k % 5, dy + k / 5);
                ASSERT_EQ(symbol_at(code, here.cell, here.section),
                          symbol_at(code, there.cell, there.section));
            }
            EXPECT_GT(margin_of_weak_view(code, place, rng), 40)
                << "view " << i << ", seed " << kSeed;
        }
    }
}

}  // namespace
}  // namespace dotpose
