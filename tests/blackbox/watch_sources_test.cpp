// Tests the messages that `dotpose watch` prints about its sources, and how it handles sources that
// end in the middle of a frame.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/image_file.hpp"
#include "watch_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::Not;

using WatchSources = WatchCommand;

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

TEST_F(WatchSources, SaysOnceWhyMostFramesFail) {
    const DriveCamera camera(188, 120);
    // An almost black frame with noise, like that of a camera in the dark.
    GreyImage dark{{}, 188, 120};
    for (std::uint32_t i = 0; i < 188 * 120; ++i)
        dark.pixels.push_back(static_cast<std::uint8_t>((i * 2654435761U >> 20) % 2 * 2));
    const auto put = [&](int i, const GreyImage& image) {
        write_pgm(directory_ / ("c" + std::to_string(100 + i) + ".pgm"), image.view());
    };
    for (int i = 0; i < 40; ++i)
        put(i, i == 3 || i >= 25 ? camera.frame(drive_, i) : dark);
    ASSERT_EQ(run("watch 'c*.pgm' --fps 10 --code anoto"), 0);
    EXPECT_EQ(count(errors_, "most frames of the last second were not located"), 1) << errors_;
}

TEST_F(WatchSources, WarnsWhenAnotherCodeExplainsTheFrames) {
    put_raw(10);
    ASSERT_EQ(run(std::string("watch - --code microdots <drive.raw ") + kRaw), 0);
    EXPECT_EQ(count(errors_, "code anoto explains the dots"), 1) << errors_;
    EXPECT_THAT(parsed(output_).at(0)["warning"].dump(), HasSubstr("code anoto explains"));
    ASSERT_EQ(run(std::string("watch - --code anoto <drive.raw ") + kRaw), 0);
    EXPECT_THAT(errors_, Not(HasSubstr("explains the dots")));
}

TEST_F(WatchSources, SaysInWhichFrameTheRobotIsTracked) {
    put_raw(1);
    const auto messages_with = [&](const std::string& options) {
        EXPECT_EQ(run("watch - <drive.raw " + options + " " + kRaw), 0) << errors_;
        return errors_;
    };
    EXPECT_THAT(messages_with(kTrack), Not(HasSubstr("place in the world")));
    ASSERT_EQ(run("sheets place right --unknown"), 0) << errors_;
    EXPECT_THAT(
        messages_with(kTrack),
        HasSubstr("the robot is lost on sheets without a place in the world, such as 'right'"));
    ASSERT_EQ(run("sheets place left --unknown"), 0) << errors_;
    EXPECT_THAT(messages_with(kTrack),
                HasSubstr("no sheet has a place in the world, so the robot is tracked in the frame "
                          "of the pattern (y down, angles clockwise)"));
    EXPECT_THAT(messages_with("--mcap run.mcap"),
                HasSubstr("poses are published in the frame of the pattern"));
    EXPECT_THAT(messages_with(""), Not(HasSubstr("frame of the pattern")));
}

TEST_F(WatchSources, LooksAtAPartOfTheFrame) {
    put_video(2, "drive.avi");
    ASSERT_EQ(run(std::string("watch drive.avi --frames 1 --roi 60,60,200x120 ") + kTrack), 0);
    const json part = parsed(output_).at(0);
    // The region of interest has the same centre as the whole frame, (159.5, 119.5).
    const DriveState truth = drive_.at(0);
    EXPECT_NEAR(part["x_m"].get<double>() * 1000, truth.x_mm, 0.02);
    EXPECT_LT(part["dots_seen"], 300);
    EXPECT_EQ(run("watch drive.avi --roi 200,0,200x100"), 2);
    EXPECT_THAT(errors_, HasSubstr("the region 200,0 200x100 leaves the frame of 320x240 px"));
    EXPECT_EQ(run("watch drive.avi --roi 200"), 2);
}

TEST_F(WatchSources, StopsCleanlyOnAnInterrupt) {
    put_raw(60);
    // The pipe stays open, so only the signal can end the run.
    shell(
        "mkfifo pipe && bash -c '(cat drive.raw; exec sleep 30) > pipe & writer=$!; "
        "\"" +
        tool_path() + "\" watch - " + std::string(kRaw) + " --draw run.svg -o run.jsonl " + kTrack +
        " < pipe 2> errors & pid=$!; "
        "until [ \"$(cat run.jsonl 2>/dev/null | wc -l)\" = 60 ]; do sleep 0.05; done; "
        "kill -INT $pid; wait $pid; echo $? > status; kill $writer'");
    EXPECT_EQ(file("status"), "0\n");
    EXPECT_EQ(parsed(file("run.jsonl")).size(), 60U);
    EXPECT_THAT(file("run.svg"), HasSubstr("</svg>"));
    EXPECT_THAT(file("errors"), HasSubstr("60 frames, 60 fixes"));
}

TEST_F(WatchSources, SaysWhatIsWrongWithTheSource) {
    EXPECT_EQ(run("watch nowhere.mp4"), 1);
    EXPECT_EQ(errors_, "dotpose: cannot read nowhere.mp4: no such file or camera\n");
    EXPECT_EQ(run("watch 99"), 1);
    EXPECT_THAT(errors_,
                testing::StartsWith("dotpose: cannot open the camera 99: there is none; "));
    std::ofstream(directory_ / "text.mp4") << "this is no video";
    EXPECT_EQ(run("watch text.mp4"), 1);
    EXPECT_EQ(errors_, "dotpose: text.mp4 is not a video, or its format is not known\n");
    EXPECT_EQ(run("watch 'nothing*.png'"), 1);
    EXPECT_EQ(errors_, "dotpose: no images at nothing*.png\n");
    EXPECT_EQ(run("watch -"), 2);
    EXPECT_EQ(errors_,
              "dotpose: raw frames need their size: --size WxH\nTry: dotpose watch --help\n");
    EXPECT_EQ(run("watch - --size 7"), 2);
    EXPECT_EQ(run("watch"), 2);
    EXPECT_EQ(run("watch --help"), 0);
    EXPECT_THAT(output_, HasSubstr("Examples:"));
}

TEST_F(WatchSources, TellsWhereRawFramesEnd) {
    put_raw(31);
    // The file is truncated in the middle of the 31st frame.
    std::ofstream(directory_ / "cut.raw", std::ios::binary)
        << file("drive.raw").substr(0, 30 * kWidth * kHeight + 1000);
    EXPECT_EQ(run("watch - " + std::string(kRaw) + " " + kTrack, (directory_ / "cut.raw").string()),
              1);
    EXPECT_EQ(parsed(output_).size(), 30U);
    EXPECT_THAT(errors_, HasSubstr("standard input ended inside frame 30: 1000 of 76800 bytes"));
}

}  // namespace
}  // namespace dotpose::test
