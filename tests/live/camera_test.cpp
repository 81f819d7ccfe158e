// Tests `dotpose watch` with a fake V4L2 camera (tests/fake_camera) and with a network camera. Each
// camera is disconnected and reconnected during the run.
#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../blackbox/tool_command.hpp"
#include "../drive.hpp"
#include "broker.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Shell function `has FILE WORD N`: waits until N lines of the file contain the word. Fails if the
/// tool exits before that.
constexpr const char* kWaiting =
    "has() { until [ $(grep -c \"$2\" $1) -ge $3 ]; do kill -0 $watch; sleep 0.05; done; }\n"
    "set -e; touch lines told; trap 'kill $camera $watch 2>/dev/null || true' EXIT\n";
/// Shell commands for a run. They wait for 30 fixes, disconnect the camera until the robot is lost,
/// connect the camera again, wait for 30 more fixes, and stop the tool. Each test defines the
/// commands `unplug` and `plug_in`.
constexpr const char* kRun =
    "has lines '\"ok\"' 30; unplug\n"
    "has told 'does not answer; waiting for it' 1; has lines '\"lost\"' 2\n"
    "plug_in; has told 'is back' 1; seen=$(grep -c '\"ok\"' lines)\n"
    "has lines '\"ok\"' $((seen + 30)); kill -INT $watch; wait $watch";

class Cameras : public ToolCommand {
  protected:
    void SetUp() override {
        ToolCommand::SetUp();
        save_drive_sheets(directory_ / "sheets.json");
        // The robot is at rest.
        const DriveCamera camera(188, 120);
        std::ofstream raw(directory_ / "camera.raw", std::ios::binary);
        for (int i = 0; i < 10; ++i) {
            const GreyImage image = camera.frame(drive_, i);
            raw.write(reinterpret_cast<const char*>(image.pixels.data()),
                      static_cast<std::streamsize>(image.pixels.size()));
        }
    }

    std::vector<json> lines() const {
        std::vector<json> lines;
        std::istringstream stream(file("lines"));
        for (std::string line; std::getline(stream, line);)
            lines.push_back(json::parse(line));
        return lines;
    }

    /// Expects that the robot was located, was lost while the camera was disconnected, and was then
    /// located again. All reported poses must be correct.
    void expect_seen_lost_and_seen() {
        std::string events;
        std::int64_t last_frame = -1;
        double last_s = 0;
        for (const json& line : lines()) {
            events += line.value("events", "") + " ";
            EXPECT_GT(line["frame"], last_frame);
            EXPECT_GT(line["t_s"], last_s);
            last_frame = line["frame"];
            last_s = line["t_s"];
            if (line["status"] != "ok") continue;
            EXPECT_NEAR(line["x_m"].get<double>() * 1000, drive_.at(0).x_mm, 0.02);
            EXPECT_NEAR(line["y_m"].get<double>() * 1000, drive_.at(0).y_mm, 0.02);
        }
        EXPECT_THAT(events, testing::MatchesRegex("fix [a-z ]*lost +fix [a-z ]*"));
        EXPECT_THAT(file("told"), HasSubstr(" 1 times lost, 0 times kidnapped, "));
    }

    const Drive drive_;
};

TEST_F(Cameras, AtThisComputer) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer must be loaded first";
#endif
    ASSERT_EQ(
        shell(
            std::string(kWaiting) +
            "export FAKE_CAMERA=$PWD/camera.raw FAKE_CAMERA_SIZE=188x120 FAKE_CAMERA_LOG=$PWD/log\n"
            "LD_PRELOAD='" +
            test::built("libdotpose_fake_camera.so") +
            "' \"$T\" watch 0 --size 188x120 --fps 100 --exposure 50 --gain 3 --no-window "
            "--sheets sheets.json -o lines 2>told & watch=$!\n"
            "unplug() { mv camera.raw away; }; plug_in() { mv away camera.raw; }\n" +
            kRun),
        0)
        << errors_ << file("told");
    expect_seen_lost_and_seen();

    std::multiset<std::string> settings;
    std::set<std::int64_t> times_us;
    std::istringstream log(file("log"));
    std::string what;
    for (std::int64_t value = 0; log >> what >> value;) {
        if (what == "time") times_us.insert(value);
        settings.insert(fmt::format("{} {}", what, value));
    }
    // The settings must be applied again after the camera has been reconnected.
    for (const char* setting : {"width 188", "fps 100", "exposure_auto 1", "exposure 50", "gain 3"})
        EXPECT_EQ(settings.count(setting), 2U) << setting;
    for (const json& line : lines()) {
        const auto time_us = std::llround(line["t_s"].get<double>() * 1e6);
        // The tool converts the driver's timestamps to milliseconds as doubles, so rounding may
        // change them by 1 µs.
        const auto at = times_us.lower_bound(time_us - 1);
        const bool is_of_driver = at != times_us.end() && *at <= time_us + 1;
        EXPECT_EQ(is_of_driver, line["status"] == "ok") << line;
    }
}

/// `plug_in` waits until the camera accepts connections. The state of its socket in /proc/net/tcp
/// is then 0A (listening), or 01 if a client has already connected.
TEST_F(Cameras, InTheNetwork) {
    ASSERT_EQ(
        shell(fmt::format("port={}\n", free_port()) + kWaiting +
              "plug_in() {\n"
              "    ffmpeg -v error -re -stream_loop -1 -f rawvideo -pix_fmt gray -s 188x120 -r 50 "
              "        -i camera.raw -c:v mjpeg -q:v 2 -pix_fmt yuvj420p -f mpjpeg -listen 1 "
              "        -content_type 'multipart/x-mixed-replace;boundary=ffmpeg' "
              "        http://127.0.0.1:$port/ & camera=$!\n"
              "    until grep -q \": [0-9A-F]*:$(printf %04X $port) [0-9A-F:]* 0[1A]\" "
              "/proc/net/tcp; do "
              "        kill -0 $camera; sleep 0.05; done; }\n"
              "unplug() { kill -KILL $camera; wait $camera || true; }\n"
              "plug_in; \"$T\" watch http://127.0.0.1:$port/stream --no-window "
              "--sheets sheets.json -o lines 2>told & watch=$!\n" +
              kRun),
        0)
        << errors_ << file("told");
    expect_seen_lost_and_seen();
}

TEST_F(Cameras, ThatIsNotThere) {
    const std::string url = fmt::format("http://127.0.0.1:{}/stream", free_port());
    EXPECT_EQ(run("watch --no-window " + url), 1);
    EXPECT_EQ(errors_, "dotpose: cannot open the camera " + url +
                           ": there is no answer, or the answer is not a video\n");
}

TEST_F(Cameras, AreListedWithSizesAndRates) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer must be loaded first";
#endif
    const std::string fake =
        "FAKE_CAMERA=$PWD/camera.raw FAKE_CAMERA_SIZE=188x120 FAKE_CAMERA_LOG=$PWD/log "
        "LD_PRELOAD='" +
        test::built("libdotpose_fake_camera.so") + "' \"$T\" watch ";
    ASSERT_EQ(shell(fake + "--list-cameras"), 0) << errors_;
    EXPECT_THAT(output_, testing::StartsWith("/dev/video0  fake\n"
                                             "  188x120     30, 15 frames/s         YUYV\n"
                                             "  640x480     15 frames/s             YUYV\n"));
    EXPECT_EQ(shell(fake + "--no-window 63"), 1);
    EXPECT_THAT(errors_, testing::StartsWith("dotpose: cannot open the camera 63: there is none; "
                                             "cameras are /dev/video0 (fake)"));
}

TEST_F(Cameras, CalibrateTakesItsFramesUntilTheUserEndsIt) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer must be loaded first";
#endif
    ASSERT_EQ(shell("export FAKE_CAMERA=$PWD/camera.raw FAKE_CAMERA_SIZE=188x120 "
                    "FAKE_CAMERA_LOG=$PWD/log\n"
                    "LD_PRELOAD='" +
                    test::built("libdotpose_fake_camera.so") +
                    "' \"$T\" calibrate 0 -o camera.yaml 2>told & tool=$!\n"
                    "until [ $(grep -c time log) -ge 10 ] || ! kill -0 $tool; do sleep 0.05; done\n"
                    "kill -INT $tool; wait $tool; echo $? > status"),
              0)
        << errors_;
    // The camera is at rest, so all frames show the same place.
    EXPECT_THAT(file("told"), HasSubstr("frames located; 1 that show new places are used"));
    EXPECT_THAT(file("told"), HasSubstr("a single frame"));
    EXPECT_EQ(file("status"), "1\n");
}

TEST_F(Cameras, NoneIsANormalResult) {
    if (fs::exists("/dev/video0")) GTEST_SKIP() << "there is a camera";
    EXPECT_EQ(run("watch --list-cameras"), 0);
    EXPECT_EQ(output_, "no camera was found at /dev/video*\n");
    EXPECT_EQ(run("watch 99999999999"), 1);
    EXPECT_EQ(errors_,
              "dotpose: cannot open the camera 99999999999: there is none; no camera was "
              "found at /dev/video*\n");
}

class Window : public Cameras {};

TEST_F(Window, ShowsTheFramesAndEndsWithAKey) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the libraries of the window keep memory to the end";
#endif
    if (shell("command -v Xvfb && command -v xdotool") != 0) GTEST_SKIP() << "no Xvfb, no xdotool";
    // Without the key press, the program would run forever.
    ASSERT_EQ(shell(std::string(kWaiting) +
                    "mkfifo display frames; Xvfb -displayfd 1 > display 2>/dev/null & camera=$!\n"
                    "read number < display; export DISPLAY=:$number QT_LOGGING_RULES='*=false'\n"
                    "(while cat camera.raw; do sleep 0.1; done) > frames 2>/dev/null &\n"
                    "\"$T\" watch - --size 188x120 -o lines < frames 2>told & watch=$!\n"
                    "has lines ok 10; window=$(xdotool search --sync --name dotpose)\n"
                    "xdotool getwindowgeometry $window; xdotool key --window $window Escape\n"
                    "wait $watch"),
              0)
        << errors_ << file("told");
    // The window shows the frame (800 px wide) and, beside it, a panel (400 px wide).
    EXPECT_THAT(output_, HasSubstr("Geometry: 1200x"));
}

TEST_F(Window, IsDoneWithoutWhereTheDisplayIsGone) {
    EXPECT_EQ(shell("DISPLAY=:nonsense \"$T\" watch - --size 188x120 < camera.raw"), 0);
    EXPECT_EQ(std::ranges::count(output_, '\n'), 10);
}

}  // namespace
}  // namespace dotpose::test
