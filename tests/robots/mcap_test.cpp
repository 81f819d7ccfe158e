// Tests MCAP files with two independent readers that check all checksums.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../temporary_directory.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/mcap_file.hpp"
#include "npm_readers.hpp"

namespace dotpose::test {
namespace {

using namespace ros;

constexpr std::int64_t kStep_ns = 10'000'000;

PoseWithCovarianceStamped pose(int number) {
    PoseWithCovarianceStamped message;
    message.header = {ros_time(number * kStep_ns), "map"};
    message.pose.pose.position.x = number / 8.0;
    return message;
}

class Mcap : public testing::Test {
  protected:
    /// Writes poses, and a status after every tenth pose.
    void write(McapFile& file, int poses) {
        const McapChannel channel = file.add_channel("/anna/pose", type_of(pose(0)));
        std::optional<McapChannel> states;
        for (int i = 0; i < poses; ++i) {
            file.write(channel, i * kStep_ns, to_cdr(pose(i)));
            if (i % 10 != 0) continue;
            const DiagnosticArray state;
            if (!states) states = file.add_channel("/anna/status", type_of(state));
            file.write(*states, i * kStep_ns, to_cdr(state));
        }
    }

    void expect_poses(const std::vector<nlohmann::json>& messages, std::size_t least,
                      std::size_t most) {
        const auto poses = of_topic(messages, "/anna/pose");
        EXPECT_GE(poses.size(), least);
        EXPECT_LE(poses.size(), most);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            ASSERT_EQ(poses[i]["sequence"], i);
            ASSERT_EQ(poses[i]["log_ns"], std::to_string(static_cast<std::int64_t>(i) * kStep_ns));
            ASSERT_EQ(poses[i]["message"]["pose"]["pose"]["position"]["x"],
                      static_cast<double>(i) / 8.0);
        }
    }

    const TemporaryDirectory directory_;
    const std::string path_ = (directory_.path() / "run.mcap").string();
};

TEST_F(Mcap, IsReadByOthers) {
    DOTPOSE_NEEDS_NPM();
    McapFile file(path_);
    write(file, 1234);  // 12 s of poses, in chunks of one second
    file.finish();
    const auto messages = read_mcap(path_);
    expect_poses(messages, 1234, 1234);
    EXPECT_EQ(of_topic(messages, "/anna/status").size(), 124U);
}

TEST_F(Mcap, WithoutMessagesIsAFileToo) {
    DOTPOSE_NEEDS_NPM();
    McapFile(path_).finish();
    EXPECT_TRUE(read_mcap(path_).empty());
}

TEST_F(Mcap, IsCompleteAtEveryMoment) {
    DOTPOSE_NEEDS_NPM();
    McapFile file(path_);
    write(file, 456);
    // The file is not finished, as if the program had been killed, so the last second may be
    // missing.
    expect_poses(read_mcap(path_), 456 - 101, 456);
    file.finish();
    expect_poses(read_mcap(path_), 456, 456);
}

TEST_F(Mcap, CutOffAnywhereItHasAllFinishedChunks) {
    DOTPOSE_NEEDS_NPM();
    McapFile file(path_);
    write(file, 456);
    file.finish();
    // The file is truncated in the middle of the data, as if the disk had been full. It has neither
    // a footer nor an index.
    std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
    const auto messages = read_mcap(path_, "--stream");
    EXPECT_GT(messages.size(), 100U);
    expect_poses(messages, 100, 300);
}

TEST_F(Mcap, LargeMessagesEndTheirChunk) {
    DOTPOSE_NEEDS_NPM();
    McapFile file(path_, {.chunk_bytes = 100'000});
    const CompressedImage image{{}, "png", std::vector<std::uint8_t>(60'000, 7)};
    const McapChannel channel = file.add_channel("/image", type_of(image));
    for (int i = 0; i < 5; ++i)
        file.write(channel, i, to_cdr(image));
    // Each chunk contains two images. The chunk of the fifth image has not been finished.
    EXPECT_EQ(read_mcap(path_).size(), 4U);
    file.finish();
    EXPECT_EQ(read_mcap(path_).size(), 5U);
}

TEST_F(Mcap, TheIndexStaysSmallerThanTheData) {
    McapFile file(path_, {.chunk_ns = 1});
    write(file, 20'000);
    file.finish();
    // The index at the end of the file has an entry for each chunk. A chunk ends only when it is at
    // least as large as the end of the file, so there are few chunks, and the index stays smaller
    // than the data.
    constexpr std::size_t kRecord = 420;  // bytes per pose: headers (9 + 22) and CDR data (4 + 384)
    EXPECT_LT(std::filesystem::file_size(path_), 20'000 * kRecord * 3 / 2);
}

TEST_F(Mcap, SaysWhatCannotBeWritten) {
    const std::string nowhere = (directory_.path() / "nowhere" / "run.mcap").string();
    EXPECT_THROW(McapFile{nowhere}, Error);
    EXPECT_THROW(McapFile{"/dev/full"}, Error);
}

}  // namespace
}  // namespace dotpose::test
