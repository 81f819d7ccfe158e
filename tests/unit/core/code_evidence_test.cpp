// How the evidence of frames for a profile adds up.
#include "dotpose/code_evidence.hpp"

#include <gtest/gtest.h>

namespace dotpose {
namespace {

constexpr Cell kPlace{1000, 2000};
/// Returns the log odds of a frame that makes this profile less likely by this log2.
CodeEvidence::LogOdds against(Profile profile, int log2) {
    CodeEvidence::LogOdds odds{};
    odds[static_cast<std::size_t>(profile)] = -256 * log2;
    return odds;
}

TEST(CodeEvidence, KnowsNothingAtFirst) {
    const CodeEvidence evidence;
    EXPECT_EQ(evidence.likeliest(), Profile::anoto);
    for (const Profile profile : {Profile::anoto, Profile::libdots, Profile::microdots}) {
        EXPECT_EQ(evidence.log2_q8(profile), 0);
        EXPECT_NEAR(evidence.p_wrong(profile), 2.0 / 3, 0.01);
    }
}

TEST(CodeEvidence, AddsUpFromPlaceToPlace) {
    CodeEvidence evidence;
    evidence.add(kPlace, against(Profile::anoto, 10));
    EXPECT_EQ(evidence.log2_q8(Profile::anoto), -10 * 256);
    evidence.add({kPlace.x + 64, kPlace.y}, against(Profile::anoto, 12));
    EXPECT_EQ(evidence.log2_q8(Profile::anoto), -22 * 256);
    EXPECT_NE(evidence.likeliest(), Profile::anoto);
    EXPECT_NEAR(evidence.p_wrong(Profile::libdots), 0.5, 0.01);
}

TEST(CodeEvidence, CountsThePlaceOnceAndItsFramesAsChances) {
    CodeEvidence evidence;
    for (int frame = 0; frame < 4; ++frame)
        evidence.add({kPlace.x + static_cast<std::uint32_t>(frame), kPlace.y},
                     against(Profile::anoto, frame == 1 ? 20 : 8));
    // The strongest of four frames counts: 20 - log2(4).
    EXPECT_NEAR(evidence.log2_q8(Profile::anoto), -18 * 256, 24);
}

TEST(CodeEvidence, IsNotBeyondBeingMended) {
    const int kMuch = -256 * 60;
    CodeEvidence evidence;
    for (std::uint32_t place = 0; place < 1000; ++place)
        evidence.add({100 * place, 0}, {0, kMuch, kMuch});
    EXPECT_EQ(evidence.likeliest(), Profile::anoto);
    EXPECT_EQ(evidence.log2_q8(Profile::libdots), -40 * 256);
    for (std::uint32_t place = 0; place < 2; ++place)
        evidence.add({100 * place, 5000}, {kMuch, 0, kMuch});
    EXPECT_EQ(evidence.likeliest(), Profile::libdots);
}

TEST(CodeEvidence, TellsFromTheOtherSideOfTheCodeWhatIsNear) {
    CodeEvidence evidence;
    evidence.add({kPositionsPerAxis - 5, 0}, against(Profile::anoto, 10));
    evidence.add({5, 10}, against(Profile::anoto, 10));
    EXPECT_NEAR(evidence.log2_q8(Profile::anoto), -9 * 256, 24);
}

}  // namespace
}  // namespace dotpose
