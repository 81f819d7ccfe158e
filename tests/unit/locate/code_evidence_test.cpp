// Tests the accumulation of evidence for a code variant over several frames.
#include "dotpose/code_evidence.hpp"

#include <array>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace dotpose {
namespace {

constexpr Cell kPlace{1000, 2000};
/// Maximum rounding error of the evidence from one place, as log2 with 8 fractional bits. Evidence
/// is rounded down.
constexpr int kRounding = 24;
/// Returns the log odds from a frame that makes `code` less likely by `log2` bits.
CodeEvidence::LogOdds against(CodeVariant code, int log2) {
    CodeEvidence::LogOdds odds{};
    odds[static_cast<std::size_t>(code)] = -256 * log2;
    return odds;
}

TEST(CodeEvidence, KnowsNothingAtFirst) {
    const CodeEvidence evidence;
    EXPECT_EQ(evidence.likeliest(), CodeVariant::anoto);
    for (const CodeVariant code :
         {CodeVariant::anoto, CodeVariant::libdots, CodeVariant::microdots}) {
        EXPECT_EQ(evidence.log2_q8(code), 0);
        EXPECT_NEAR(evidence.p_wrong(code), 2.0 / 3, 0.01);
    }
}

TEST(CodeEvidence, AddsUpFromPlaceToPlace) {
    CodeEvidence evidence;
    evidence.add(kPlace, against(CodeVariant::anoto, 10));
    EXPECT_NEAR(evidence.log2_q8(CodeVariant::anoto), -10 * 256, kRounding);
    evidence.add({kPlace.x + 64, kPlace.y}, against(CodeVariant::anoto, 12));
    EXPECT_NEAR(evidence.log2_q8(CodeVariant::anoto), -22 * 256, 2 * kRounding);
    EXPECT_NE(evidence.likeliest(), CodeVariant::anoto);
    EXPECT_NEAR(evidence.p_wrong(CodeVariant::libdots), 0.5, 0.01);
}

TEST(CodeEvidence, CountsThePlaceOnceAtTheMeanOfItsFrames) {
    CodeEvidence evidence;
    for (const int log2 : {8, 20, 8, 8})
        evidence.add({kPlace.x + static_cast<std::uint32_t>(log2), kPlace.y},
                     against(CodeVariant::anoto, log2));
    // (2^20 + 3 * 2^8) / 4 is just above 2^18.
    EXPECT_NEAR(evidence.log2_q8(CodeVariant::anoto), -18 * 256, kRounding);
    // Frames with equal evidence do not change the mean.
    CodeEvidence alike;
    for (int frame = 0; frame < 1000; ++frame)
        alike.add(kPlace, against(CodeVariant::anoto, 20));
    EXPECT_NEAR(alike.log2_q8(CodeVariant::anoto), -20 * 256, kRounding);
}

TEST(CodeEvidence, CountsAPlaceAtMost32BitsHoweverManyFramesSayMore) {
    CodeEvidence evidence;
    for (int frame = 0; frame < 3; ++frame)
        evidence.add(kPlace, against(CodeVariant::anoto, 60));
    EXPECT_EQ(evidence.log2_q8(CodeVariant::anoto), -32 * 256);
    // Adds 255 neutral frames for each of the 3 frames above. The factor of each of these 3 frames
    // is limited to 2^40, so the mean factor over all frames is 2^40 / 256 = 2^32.
    for (int frame = 0; frame < 3 * 255; ++frame)
        evidence.add(kPlace, against(CodeVariant::anoto, 0));
    EXPECT_NEAR(evidence.log2_q8(CodeVariant::anoto), -32 * 256, kRounding);
    for (int frame = 0; frame < 3 * 256 * 3; ++frame)
        evidence.add(kPlace, against(CodeVariant::anoto, 0));
    EXPECT_NEAR(evidence.log2_q8(CodeVariant::anoto), -30 * 256, kRounding);
}

TEST(CodeEvidence, FramesAgainstEachOtherCancelOut) {
    CodeEvidence evidence;
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::libdots}) {
        for (int frame = 0; frame < 5; ++frame)
            evidence.add(kPlace, against(code, 60));
    }
    EXPECT_EQ(evidence.log2_q8(CodeVariant::anoto), evidence.log2_q8(CodeVariant::libdots));
}

// Simulates overlapping views of the same bits. The probability that a bit is 1 is 1/2 in the true
// code variant and 3/4 in the other code variants. Each bit in view therefore multiplies the odds
// of the other code variants by 1.5 (if it is 1) or by 0.5 (if it is 0).
TEST(CodeEvidence, IsSeldomMuchAgainstTheTruth) {
    constexpr std::size_t kBits = 40;
    constexpr std::size_t kSeen = 25;
    constexpr int kSheets = 20'000;
    std::mt19937 random(5);
    std::array<int, 24> sheets_by_bits{};
    for (int sheet = 0; sheet < kSheets; ++sheet) {
        std::array<int, kBits> log2_q8;
        for (int& bit : log2_q8)
            bit = random() % 2 == 0 ? 150 : -256;
        CodeEvidence evidence;
        for (int frame = 0; frame < 20; ++frame) {
            const int* first = log2_q8.data() + random() % (kBits - kSeen);
            evidence.add(kPlace, {-std::accumulate(first, first + kSeen, 0), 0, 0});
        }
        const int bits = -evidence.log2_q8(CodeVariant::anoto) / 256;
        ++sheets_by_bits[static_cast<std::size_t>(bits)];
    }
    int beyond = kSheets;
    for (int k = 1; k < 6; ++k) {
        beyond -= sheets_by_bits[static_cast<std::size_t>(k - 1)];
        EXPECT_LE(beyond, kSheets / ((1 << k) - 1)) << k;
    }
    EXPECT_GT(beyond, 20);
}

TEST(CodeEvidence, IsNotBeyondBeingMended) {
    const int kMuch = -256 * 60;
    CodeEvidence evidence;
    for (std::uint32_t place = 0; place < 1000; ++place)
        evidence.add({100 * place, 0}, {0, kMuch, kMuch});
    EXPECT_EQ(evidence.likeliest(), CodeVariant::anoto);
    EXPECT_EQ(evidence.log2_q8(CodeVariant::libdots), -40 * 256);
    for (std::uint32_t place = 0; place < 2; ++place)
        evidence.add({100 * place, 5000}, {kMuch, 0, kMuch});
    EXPECT_EQ(evidence.likeliest(), CodeVariant::libdots);
}

TEST(CodeEvidence, TellsFromTheOtherSideOfTheCodeWhatIsNear) {
    CodeEvidence evidence;
    evidence.add({kPositionsPerAxis - 5, 0}, against(CodeVariant::anoto, 10));
    evidence.add({5, 10}, against(CodeVariant::anoto, 10));
    EXPECT_NEAR(evidence.log2_q8(CodeVariant::anoto), -10 * 256, kRounding);
}

}  // namespace
}  // namespace dotpose
