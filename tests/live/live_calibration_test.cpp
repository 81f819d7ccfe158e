// Tests `dotpose calibrate --live` with a fake V4L2 camera (tests/fake_camera), without and with a
// window.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../blackbox/tool_command.hpp"
#include "dotpose/files/camera_file.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

class LiveCalibration : public ToolCommand {
  protected:
    /// Writes camera.raw, which contains three frames for each of 30 places, as if the camera had
    /// stopped at each place.
    void SetUp() override {
        ToolCommand::SetUp();
        ASSERT_EQ(run("simulate -o frames --seed 5 --k -8.7e-6 --frames 30"), 0) << errors_;
        ASSERT_EQ(shell("ffmpeg -v error -framerate 30 -i frames/frame_%06d.pgm -vf fps=90 "
                        "-f rawvideo -pix_fmt gray camera.raw"),
                  0)
            << errors_;
    }
};

TEST_F(LiveCalibration, OfACameraEndsByItself) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer must be loaded first";
#endif
    // After the last frame, the fake camera repeats the file from the first frame.
    ASSERT_EQ(shell("export FAKE_CAMERA=$PWD/camera.raw FAKE_CAMERA_SIZE=188x120 "
                    "FAKE_CAMERA_LOG=$PWD/log\n"
                    "LD_PRELOAD='" +
                    test::built("libdotpose_fake_camera.so") +
                    "' \"$T\" calibrate --live 0 --size 188x120 --fps 30 --no-window "
                    "-o camera.yaml"),
              0)
        << errors_;
    EXPECT_THAT(output_, HasSubstr("verdict     good"));
    EXPECT_THAT(errors_, HasSubstr("dotpose: 1 frame taken"));
    const Camera camera = read_camera(directory_ / "camera.yaml");
    EXPECT_NEAR(camera.k_per_px2, -8.7e-6, 4 * camera.sigma.at("k_per_px2"));
}

TEST_F(LiveCalibration, HasAWindowAndEndsWithAKey) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the libraries of the window keep memory to the end";
#endif
    if (shell("command -v Xvfb && command -v xdotool") != 0) GTEST_SKIP() << "no Xvfb, no xdotool";
    // The camera shows only 2 places, which are too few for a calibration. Without the key press,
    // the program would run forever.
    ASSERT_EQ(
        shell("mkfifo display frames.raw; Xvfb -displayfd 1 > display 2>/dev/null & server=$!\n"
              "trap 'kill $server' EXIT; head -c $((188 * 120 * 6)) camera.raw > two.raw\n"
              "read number < display; export DISPLAY=:$number QT_LOGGING_RULES='*=false'\n"
              "(while cat two.raw; do sleep 0.1; done) > frames.raw 2>/dev/null &\n"
              "\"$T\" calibrate --live - --size 188x120 -o camera.yaml < frames.raw 2>told & "
              "tool=$!\n"
              "window=$(xdotool search --sync --name dotpose)\n"
              "xdotool getwindowgeometry $window; sleep 1; xdotool key --window $window q\n"
              "wait $tool; status=$?; cat told >&2; (exit $status)"),
        1)
        << errors_;
    EXPECT_THAT(output_, HasSubstr("Geometry: 1200x"));
    EXPECT_THAT(errors_, HasSubstr("no file was written"));
    EXPECT_THAT(errors_, HasSubstr("take more frames (2 of 5)"));
    EXPECT_FALSE(fs::exists(directory_ / "camera.yaml"));
}

}  // namespace
}  // namespace dotpose::test
