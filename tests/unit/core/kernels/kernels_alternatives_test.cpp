// Tests lists of similar places and expected odds against simple reference computations.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include "core/kernels/kernels.hpp"
#include "random_inputs.hpp"

namespace dotpose::core_test::kernels_alternatives_test {
namespace {

using namespace core;

/// The places of a reading in the four sequences. `offset` compares the rolls of a line at two
/// places in sequence `k`: it returns the roll at `place` minus the roll at the place of the
/// reading, modulo 63.
struct OwnPlaces {
    const code::Basis& basis;
    std::array<std::uint32_t, 4> own;

    explicit OwnPlaces(Rng& rng) : basis(code::basis(static_cast<CodeVariant>(rng.below(3)))) {
        for (std::size_t k = 0; k < own.size(); ++k)
            own[k] = rng.below(basis[k].length);
    }
    int offset(std::size_t k, std::uint32_t place, int line) const {
        return (basis[k].rolls[place + static_cast<std::uint32_t>(line)] -
                basis[k].rolls[own[k] + static_cast<std::uint32_t>(line)] + 63) %
               63;
    }
};

TEST(KernelsAlternatives, SimilarPlacesLoseTooLittleByTheirSteps) {
    int count = 0;
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        const OwnPlaces places(rng);
        StepLosses steps;
        steps.count = whole(rng, 0, 63);
        for (std::uint8_t& parts : steps.parts)
            parts = static_cast<std::uint8_t>(std::min(whole(rng, 0, 9), StepLosses::kLimitParts));
        for (std::size_t k = 0; k < 4; ++k) {
            const code::Secondary& a = places.basis[k];
            const PlaceBits similar = kernels.find_similar_places(a, places.own[k], steps);
            for (std::uint32_t place = 0; place < 256; ++place) {
                const bool is_similar = (similar[place / 32] >> place % 32 & 1) != 0;
                if (place >= a.length || place == places.own[k]) {
                    ASSERT_FALSE(is_similar);
                    continue;
                }
                // Computes the maximum total loss over all sets of steps. A set contains only steps
                // at which the digits differ, and no two adjacent steps.
                int most = 0;
                int max_before = 0;
                for (int step = 0; step < steps.count; ++step) {
                    const auto at = static_cast<std::uint32_t>(step);
                    const bool differ = a.digit((place + at) % a.length) !=
                                        a.digit((places.own[k] + at) % a.length);
                    const int with_this = max_before + (differ ? steps.parts[at] : 0);
                    max_before = most;
                    most = std::max(most, with_this);
                }
                if (most >= StepLosses::kLimitParts) continue;
                ASSERT_TRUE(is_similar) << k << ' ' << place;
                ++count;
            }
        }
    });
    EXPECT_GT(count, 1000);
}

TEST(KernelsAlternatives, ListHasAllPlacesThatLoseTooLittle) {
    int listed = 0;
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        const OwnPlaces places(rng);
        std::vector<LineLoss> lines;
        const int count = whole(rng, 8, 40);
        for (int line = 0; line < count; ++line)
            lines.push_back(
                {static_cast<std::uint8_t>(line), static_cast<std::uint8_t>(whole(rng, 1, 4))});
        std::stable_sort(lines.begin(), lines.end(),
                         [](LineLoss a, LineLoss b) { return a.loss > b.loss; });
        const int enough = whole(rng, 4, 14);
        SimilarPlaceList list;
        const auto sequences = static_cast<unsigned>(whole(rng, 1, 15));
        if (!kernels.list_similar_places(places.basis, places.own, sequences, lines, enough, list))
            return;
        // Each element consists of a sequence, a place, and the shift at which the place shares a
        // line with the reading.
        std::set<std::array<int, 3>> found;
        for (const auto& [k, place, line, loss] :
             std::span(list.places).first(static_cast<std::size_t>(list.count)))
            found.insert({k, place, places.offset(k, place, line)});
        for (std::size_t k = 0; k < 4; ++k) {
            if ((sequences >> k & 1) == 0) {
                const auto is_of_it = [&](const auto& alternative) {
                    return alternative[0] == static_cast<int>(k);
                };
                ASSERT_TRUE(std::none_of(found.begin(), found.end(), is_of_it)) << k;
                continue;
            }
            for (std::uint32_t place = 0; place < places.basis[k].length; ++place) {
                if (place == places.own[k]) continue;
                for (int shift = 0; shift < 63; ++shift) {
                    int lost = 0;
                    for (const auto& [line, loss] : lines)
                        lost += places.offset(k, place, line) == shift ? 0 : loss;
                    const std::array<int, 3> alternative{static_cast<int>(k),
                                                         static_cast<int>(place), shift};
                    // The kernel adds up only the losses of lines after the shared line. The list
                    // may therefore also contain places whose total loss exceeds the limit. The
                    // test allows such places.
                    if (lost >= enough) continue;
                    ASSERT_TRUE(found.count(alternative) > 0) << k << ' ' << place << ' ' << shift;
                    ++listed;
                }
            }
        }
    });
    EXPECT_GT(listed, 100);
}

TEST(KernelsAlternatives, LeastLossesAreThoseOfSortedLosses) {
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        // In half of the rounds, losses are limited to the range from -1 to 3, so that some losses
        // are equal.
        const int most = whole(rng, 0, 1) == 0 ? 3 : INT16_MAX;
        std::vector<std::int16_t> losses;
        const int count = whole(rng, 8, 16);
        for (int line = 0; line < count; ++line)
            losses.push_back(static_cast<std::int16_t>(whole(rng, -most / 2, most)));
        SmallestSums sums;
        kernels.sum_smallest_losses(losses, sums);
        std::sort(losses.begin(), losses.end());
        int expected = 0;
        ASSERT_EQ(sums[0], 0);
        for (std::size_t n = 1; n < sums.size(); ++n) {
            expected += std::max<int>(losses[n - 1], 0);
            ASSERT_EQ(sums[n], expected) << n;
        }
    });
}

TEST(KernelsAlternatives, CombinationsOfABatchLoseTheLinesTheyDoNotShare) {
    int similar_count = 0;
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        OffsetBatch batch;
        std::array<std::uint8_t, kMaxLines> opposite;
        std::vector<std::uint8_t> losses(static_cast<std::size_t>(whole(rng, 1, 20)));
        for (std::size_t line = 0; line < losses.size(); ++line) {
            losses[line] = static_cast<std::uint8_t>(whole(rng, 0, 60));
            opposite[line] = static_cast<std::uint8_t>(whole(rng, 0, 3));
            for (std::uint8_t& offset : batch.offsets[line])
                offset = static_cast<std::uint8_t>(whole(rng, 0, 3));
        }
        const int limit = whole(rng, 1, 255);
        const std::uint32_t similar =
            kernels.similar_in_batch(batch, opposite.data(), losses, limit);
        for (std::size_t n = 0; n < 32; ++n) {
            int lost = 0;
            for (std::size_t line = 0; line < losses.size(); ++line)
                lost += batch.offsets[line][n] != opposite[line] ? losses[line] : 0;
            const bool is_similar = (similar >> n & 1) != 0;
            ASSERT_EQ(is_similar, lost < limit) << n;
            similar_count += is_similar ? 1 : 0;
        }
    });
    EXPECT_GT(similar_count, 100);
}

TEST(KernelsAlternatives, ExpectationsHaveTheSameBitsInEachForm) {
    repeat_with_each_form(5, [&](const Kernels& kernels, Rng& rng) {
        const OwnPlaces places(rng);
        std::vector<OddsByOffset> lines(static_cast<std::size_t>(whole(rng, 1, 20)));
        for (OddsByOffset& line : lines) {
            for (float& odds : line)
                odds = static_cast<float>(std::exp2(-rng.uniform(0, 40)));
            line.front() = 1;
            line.back() = 0;
        }
        const auto different = static_cast<unsigned>(whole(rng, 1, 15));
        const int max_shared = whole(rng, 3, 8);
        const float sum = kernels.sum_expected_alternatives(places.basis, places.own, different,
                                                            lines, max_shared);
        EXPECT_GT(sum, 0);
        EXPECT_EQ(sum, portable_kernels().sum_expected_alternatives(places.basis, places.own,
                                                                    different, lines, max_shared));
        OddsByShared by_shared;
        OddsByShared expected;
        const std::uint64_t anchors = std::uint64_t{rng.below(1 << 20)};
        kernels.sum_expected_doubles(places.basis, places.own, lines, anchors, by_shared);
        portable_kernels().sum_expected_doubles(places.basis, places.own, lines, anchors, expected);
        EXPECT_EQ(by_shared, expected);
    });
}

/// Expected odds in double precision, indexed by the roll offset and by the length of the current
/// run. The current run consists of adjacent lines in which the alternative has the roll offset 0
/// and the digits of the reading. It ends with the line processed last.
using OddsByRun = std::array<std::array<double, 66>, 63>;

/// Calls `use` for every choice of digits at one step. Digits are chosen only in sequences with
/// index `k` or higher whose bits in `different` are set. The first argument of `use` is the change
/// of the roll modulo 63. The second argument is true if all digits equal the digits of the
/// reading. `shift` and `are_equal` are these two values for the sequences before `k`.
void visit_digits(const OwnPlaces& places, unsigned different, std::size_t line, std::size_t k,
                  int shift, bool are_equal, const auto& use) {
    if (k == 4) return use((shift + 63 * 63) % 63, are_equal);
    if ((different >> k & 1) == 0)
        return visit_digits(places, different, line, k + 1, shift, are_equal, use);
    const code::Secondary& a = places.basis[k];
    const int own = a.digit((places.own[k] + static_cast<std::uint32_t>(line)) % a.length);
    for (int digit = 0; digit < a.base; ++digit) {
        visit_digits(places, different, line, k + 1, shift + a.weight * (digit - own),
                     are_equal && digit == own, use);
    }
}

double expected_in_double(const OwnPlaces& places, unsigned different,
                          const std::vector<OddsByOffset>& lines, int max_shared) {
    double alternatives = 1;
    double equal = 1.03;  // safety factor for each step
    for (std::size_t k = 0; k < 4; ++k) {
        if ((different >> k & 1) == 0) continue;
        alternatives *= places.basis[k].length;
        equal /= places.basis[k].base;
    }
    OddsByRun odds{};
    for (std::size_t shift = 0; shift < 63; ++shift)
        odds[shift][shift == 0 ? 1 : 0] = static_cast<double>(lines[0][shift]);
    for (std::size_t line = 1; line < lines.size(); ++line) {
        OddsByRun next{};
        for (std::size_t offset = 0; offset < 63; ++offset) {
            for (std::size_t run = 0; run <= static_cast<std::size_t>(max_shared); ++run) {
                if (odds[offset][run] == 0) continue;
                visit_digits(places, different, line - 1, 0, 0, true, [&](int shift, bool same) {
                    const std::size_t now = (offset + static_cast<std::size_t>(shift)) % 63;
                    const std::size_t run_now = now != 0 ? 0 : same && run > 0 ? run + 1 : 1;
                    next[now][run_now] +=
                        odds[offset][run] * equal * static_cast<double>(lines[line][now]);
                });
            }
        }
        odds = next;
    }
    double sum = 0;
    for (const auto& by_run : odds)
        sum += std::accumulate(by_run.begin(), by_run.begin() + max_shared + 1, 0.0);
    return alternatives * sum;
}

/// In a view of two patterns, 12 adjacent lines make the alternatives less probable, and the other
/// 9 lines make them more probable. The product of the odds of the 12 lines is far below the
/// smallest float, so the kernel must rescale its sums to avoid underflow.
TEST(KernelsAlternatives, ExpectationsOfTwoPatternsAreThoseInDoublePrecision) {
    repeat_with_each_form(3, [&](const Kernels& kernels, Rng& rng) {
        const OwnPlaces places(rng);
        const bool loses_first = rng.below(2) == 0;
        constexpr std::size_t kLosing = 12;
        std::vector<OddsByOffset> lines(21);
        for (std::size_t n = 0; n < lines.size(); ++n) {
            const std::size_t rank = loses_first ? n : lines.size() - 1 - n;
            for (float& odds : lines[n]) {
                odds = static_cast<float>(
                    std::exp2(rank < kLosing ? -rng.uniform(20, 64) : rng.uniform(6, 14)));
            }
            lines[n].front() = 1;
            lines[n].back() = 0;
        }
        const auto different = static_cast<unsigned>(whole(rng, 1, 15));
        const double expected = expected_in_double(places, different, lines, 5);
        const double sum = static_cast<double>(
            kernels.sum_expected_alternatives(places.basis, places.own, different, lines, 5));
        EXPECT_NEAR(sum / expected, 1, 1e-3) << different << ' ' << loses_first;
    });
}

}  // namespace
}  // namespace dotpose::core_test::kernels_alternatives_test
