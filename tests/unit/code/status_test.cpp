// Tests the names and messages of statuses. A name is the identifier in the code, and a message is
// one plain sentence.
#include "dotpose/status.hpp"

#include <cctype>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "../../paths.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/pose_packet.hpp"
#include "gtest/gtest.h"

namespace dotpose::code_test::status_test {
namespace {

#define NAMED(status) \
    { Status::status, #status }
constexpr std::pair<Status, const char*> kNames[] = {
    NAMED(ok),
    NAMED(bad_argument),
    NAMED(image_too_small),
    NAMED(image_too_large),
    NAMED(no_contrast),
    NAMED(too_few_dots),
    NAMED(no_grid),
    NAMED(no_displacement),
    NAMED(grid_too_small),
    NAMED(not_run),
    NAMED(mirrored),
    NAMED(bad_window),
    NAMED(not_in_code),
    NAMED(ambiguous),
    NAMED(not_certain),
    NAMED(not_tracked),
    NAMED(ambiguous_code),
    NAMED(other),
};
#undef NAMED
static_assert(std::size(kNames) == kStatusCount + 1, "a status without a name in this test");

TEST(Status, NameIsTheIdentifier) {
    for (const auto& [status, identifier] : kNames)
        EXPECT_STREQ(name(status), identifier);
}

TEST(Status, ValuesCountFromZero) {
    for (std::size_t i = 0; i < kStatusCount; ++i) {
        EXPECT_EQ(static_cast<std::size_t>(kNames[i].first), i) << kNames[i].second;
    }
}

// Receivers written in other languages decode the numbers according to docs/pose-packet.md, so the
// table there must be complete and correct.
TEST(Status, NumbersAreThoseOfTheDocumentedPackets) {
    std::ifstream file(test::source_dir() + "/docs/pose-packet.md");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    for (const auto& [status, identifier] : kNames) {
        const std::string row = "\n| " + std::to_string(static_cast<int>(status)) + " | " +
                                identifier + " | " + message(status) + " |\n";
        EXPECT_NE(text.find(row), std::string::npos) << "no such row:" << row;
    }
}

// Devices and hosts of different versions exchange these numbers, so no number may ever change.
TEST(Status, NumbersAreThoseOfTheFirstVersion) {
    EXPECT_EQ(static_cast<int>(Status::ok), 0);
    EXPECT_EQ(static_cast<int>(Status::grid_too_small), 8);
    EXPECT_EQ(static_cast<int>(Status::mirrored), 10);
    EXPECT_EQ(static_cast<int>(Status::ambiguous_code), 16);
    EXPECT_EQ(static_cast<int>(Status::other), 255);
}

TEST(Status, NumbersOfNewerVersionsAreOther) {
    for (const int number : {kStatusCount, 100, 254}) {
        EXPECT_STREQ(name(static_cast<Status>(number)), "other");
        EXPECT_STREQ(message(static_cast<Status>(number)), message(Status::other));
    }
}

TEST(Status, NothingIsKnownOfAFrameBeforeItIsLocated) {
    EXPECT_EQ(Fix{}.status, Status::not_run);
    EXPECT_EQ(PosePacket{}.status, Status::not_run);
}

TEST(Status, EveryMessageIsItsOwnPlainSentence) {
    std::set<std::string> messages;
    for (const auto& [status, identifier] : kNames) {
        SCOPED_TRACE(identifier);
        const std::string text = message(status);
        ASSERT_FALSE(text.empty());
        EXPECT_TRUE(std::islower(static_cast<unsigned char>(text.front()))) << text;
        EXPECT_EQ(std::string(".!\n ").find(text.back()), std::string::npos) << text;
        EXPECT_EQ(text.find('_'), std::string::npos) << "an identifier, not a sentence: " << text;
        EXPECT_TRUE(messages.insert(text).second) << "said twice: " << text;
    }
}

}  // namespace
}  // namespace dotpose::code_test::status_test
