// Tests the output of long operations on a terminal: progress with the estimated remaining time,
// colour, and partial results after Ctrl-C. The `script` program runs the tool on a
// pseudo-terminal.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/simulate.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kRed = "\033[31m";

class Feedback : public ToolCommand {
  protected:
    int on_terminal(const std::string& arguments, const std::string& environment) {
        return shell("export T; env -u NO_COLOR " + environment + " script -qec '\"$T\" " +
                     arguments + "' /dev/null </dev/null");
    }

    /// Runs shell commands that start the tool and write its process id to the file pid. When the
    /// shell command `condition` succeeds, sends SIGINT to the tool, as Ctrl-C does.
    int interrupt(const std::string& commands, const std::string& condition) {
        return shell("export T; { " + commands + "; } & job=$!; until [ -s pid ] && { " +
                     condition +
                     "; } || ! kill -0 $job; do sleep 0.01; done; kill -INT $(cat pid); " +
                     "touch done; wait $job");
    }

    void put_raw(int frames) {
        dotpose::Setup setup;
        setup.seed = 3;
        std::ofstream raw(directory_ / "frames.raw", std::ios::binary);
        for (int i = 0; i < frames; ++i) {
            const GreyImage image = render(draw_shot(setup, static_cast<std::uint64_t>(i)));
            raw.write(reinterpret_cast<const char*>(image.pixels.data()),
                      static_cast<std::streamsize>(image.pixels.size()));
        }
    }

    /// Shell command that writes raw frames and then keeps the pipe open.
    static constexpr const char* kEndless =
        "{ cat frames.raw; touch fed; until [ -e done ]; do sleep 0.02; done; } | ";
    /// Shell command that starts the tool and writes its process id to the file pid.
    static constexpr const char* kTool = "sh -c 'echo $$ >pid; exec \"$T\" \"$@\"' sh ";
};

TEST_F(Feedback, LongWorkShowsProgressAndTheTimeLeft) {
    interrupt(
        "script -qefc 'echo $$ >pid; exec \"$T\" simulate -o frames --frames 1000000' seen "
        "</dev/null >/dev/null",
        "grep -q left seen");
    EXPECT_THAT(file("seen"), ContainsRegex("simulating frames: [0-9]+ %, .*[0-9]+ (min|s) left"));
    EXPECT_THAT(file("seen"), HasSubstr("interrupted; the frames so far are complete"));
}

TEST_F(Feedback, CtrlCKeepsTheLinesOfLocate) {
    put_raw(4);
    EXPECT_NE(interrupt(std::string(kEndless) + kTool + "locate - --size 188x120 -o lines",
                        "[ \"$(grep -c . lines)\" = 4 ]"),
              0);
    const std::vector<std::string> lines = lines_of(file("lines"));
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_EQ(json::parse(lines.back())["status"], "ok");
    EXPECT_THAT(errors_, HasSubstr("interrupted; the lines so far are complete"));
}

TEST_F(Feedback, CtrlCKeepsTheFramesThatCalibrateHasRead) {
    put_raw(12);
    interrupt(std::string(kEndless) + kTool + "calibrate - --size 188x120 -o camera.yaml",
              "[ -e fed ]");
    EXPECT_THAT(errors_, HasSubstr("no more frames are read"));
    EXPECT_THAT(output_, HasSubstr("verdict "));
    EXPECT_THAT(file("camera.yaml"), HasSubstr("k_per_px2"));
}

TEST_F(Feedback, CtrlCKeepsTheUnreadableFramesOfEvaluate) {
    ASSERT_EQ(run("simulate -o frames --frames 2 --size 640x480"), 0) << errors_;
    std::filesystem::resize_file(directory_ / "frames/frame_000000.pgm", 100);
    std::ofstream list(directory_ / "list");
    list << "frames/frame_000000.pgm\n";
    for (int i = 0; i < 30'000; ++i)
        list << "frames/frame_000001.pgm\n";
    list.close();
    // Interrupts the tool after 1.5 s of CPU time (150 clock ticks). By then, the tool has
    // located some of the frames, but not all: reading the list takes up to 0.5 s, and locating all
    // frames takes about 6 s.
    EXPECT_EQ(interrupt(std::string("exec ") + kTool + "evaluate --list list --format json",
                        "[ \"$(cut -d ' ' -f 14 /proc/$(cat pid)/stat)\" -gt 150 ]"),
              1);
    EXPECT_THAT(errors_, ContainsRegex("the report covers the first [1-9][0-9]* of 30001"));
    EXPECT_THAT(errors_, HasSubstr("frame_000000.pgm"));
    const json report = json::parse(output_);
    EXPECT_EQ(report["unreadable"], 1);
    EXPECT_GT(report["located"], 0);
}

TEST_F(Feedback, CtrlCKeepsTheFramesThatEvaluateHasSeen) {
    EXPECT_EQ(interrupt(std::string("exec ") + kTool +
                            "evaluate --preset nominal --frames 1000000 --format json",
                        "[ \"$(cut -d ' ' -f 14 /proc/$(cat pid)/stat)\" -gt 30 ]"),
              1);
    EXPECT_THAT(errors_, ContainsRegex("the report covers the first [1-9][0-9]* of 1000000"));
    const json report = json::parse(output_);
    EXPECT_GT(report["frames"], 0);
    EXPECT_LT(report["frames"], 1'000'000);
    EXPECT_EQ(report["wrong"], 0);
}

TEST_F(Feedback, ColourIsForTerminalsThatWantIt) {
    const std::string optics = "optics --size 188x120 --speed 5000";
    ASSERT_EQ(on_terminal(optics, "TERM=xterm"), 1);
    EXPECT_THAT(output_, HasSubstr(std::string(kRed) + "CHANGE:\033[0m "));
    for (const char* refusal : {"TERM=xterm NO_COLOR=1", "TERM=dumb"}) {
        ASSERT_EQ(on_terminal(optics, refusal), 1);
        EXPECT_THAT(output_, AllOf(HasSubstr("CHANGE: "), Not(HasSubstr(kRed)))) << refusal;
    }
    ASSERT_EQ(run(optics), 1);
    EXPECT_THAT(output_, AllOf(HasSubstr("CHANGE: "), Not(HasSubstr(kRed))));
    EXPECT_EQ(on_terminal("locate", "TERM=xterm"), 2);
    EXPECT_THAT(output_, HasSubstr(std::string(kRed) + "dotpose:\033[0m no source"));
}

}  // namespace
}  // namespace dotpose::test
