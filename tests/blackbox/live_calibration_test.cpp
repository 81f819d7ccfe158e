// Tests `dotpose calibrate --live` without a display. The tool must accept only frames that add
// information, report which requirements are not met, and end automatically.
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "dotpose/files/camera_file.hpp"
#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kPaperLens_per_px2 = -8.7e-6;

class LiveCalibration : public ToolCommand {
  protected:
    void simulate(const std::string& options) {
        ASSERT_EQ(run("simulate -o frames --seed 5 --k -8.7e-6 " + options), 0) << errors_;
    }

    /// Writes the images as raw frames to `name`. Each image is repeated three times, as if the
    /// camera were at rest.
    void put_raw(const std::string& name, int first = 0) {
        ASSERT_EQ(shell(fmt::format("ffmpeg -v error -framerate 30 -start_number {} "
                                    "-i frames/frame_%06d.pgm -vf fps=90 -f rawvideo "
                                    "-pix_fmt gray {}",
                                    first, name)),
                  0)
            << errors_;
    }

    int calibrate(const std::string& arguments) {
        return run("calibrate --live --no-window " + arguments + " -o camera.yaml");
    }

    bool has_file() const { return fs::exists(directory_ / "camera.yaml"); }

    void expect_paper_lens() const {
        const Camera camera = read_camera(directory_ / "camera.yaml");
        EXPECT_NEAR(camera.k_per_px2, kPaperLens_per_px2, 4 * camera.sigma.at("k_per_px2"));
        EXPECT_LT(camera.sigma.at("k_per_px2"), 1e-7);
    }

    int used() const {
        std::smatch match;
        const std::regex pattern("frames +([0-9]+) of ([0-9]+) located");
        return std::regex_search(output_, match, pattern) ? std::stoi(match[1]) : -1;
    }
};

TEST_F(LiveCalibration, EndsByItselfOnceNothingIsMissing) {
    simulate("--frames 45");
    ASSERT_EQ(calibrate("frames --save kept"), 0) << errors_;
    expect_paper_lens();
    EXPECT_THAT(errors_, HasSubstr("dotpose: 1 frame taken; "));
    EXPECT_THAT(errors_, HasSubstr("next: "));
    EXPECT_THAT(errors_, Not(HasSubstr("could be improved")));
    EXPECT_THAT(output_, HasSubstr("verdict     good"));
    EXPECT_THAT(output_, HasSubstr("corner      known to 0.09"));
    EXPECT_GE(used(), 5);
    EXPECT_LT(used(), 45);
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_ / "kept"), {}), used());
    // The video shows each image three times. The calibration must use each image only once, so the
    // result must be the same as for the images.
    const std::string report = output_;
    const std::string file_of_images = file("camera.yaml");
    put_raw("resting.raw");
    ASSERT_EQ(calibrate("--size 188x120 --fps 90 - <resting.raw"), 0) << errors_;
    EXPECT_EQ(output_, report);
    EXPECT_EQ(file("camera.yaml"), file_of_images);
}

TEST_F(LiveCalibration, SaysWhatWasMissingAndWritesNothing) {
    simulate("--frames 3");
    EXPECT_EQ(calibrate("frames"), 1);
    EXPECT_FALSE(has_file());
    EXPECT_THAT(errors_,
                HasSubstr("not enough was seen, and no file was written: of 3 frames, 3 "
                          "were located and 3 taken (0 out of focus, 0 moving); missing: "));
    EXPECT_THAT(errors_, HasSubstr("take more frames (3 of 5)"));
    EXPECT_EQ(output_, "");

    simulate("--frames 12 --preset clean --section 3,4 --at 5000,7000 --angle 20");
    EXPECT_EQ(calibrate("frames"), 1);
    EXPECT_FALSE(has_file());
    EXPECT_THAT(errors_, HasSubstr("were located and 1 taken"));
    EXPECT_THAT(errors_, HasSubstr("move to other places of the sheet (1 of 4 seen)"));
    EXPECT_THAT(errors_, HasSubstr("turn the camera on the paper (1 of 3 directions)"));
}

TEST_F(LiveCalibration, TakesNoFrameThatIsOutOfFocus) {
    simulate("--frames 4 --preset clean --blur 1.7");
    EXPECT_EQ(calibrate("frames"), 1);
    EXPECT_FALSE(has_file());
    EXPECT_THAT(errors_, HasSubstr("and 0 taken (4 out of focus, 0 moving)"));
}

TEST_F(LiveCalibration, SaysWhyNoFrameIsLocated) {
    ASSERT_EQ(run("simulate -o frames --seed 5 --frames 3 --scene black"), 0);
    EXPECT_EQ(calibrate("frames"), 1);
    EXPECT_THAT(errors_, HasSubstr("of 3 frames, 0 were located and 0 taken "));
    EXPECT_THAT(errors_, HasSubstr("dark"));
}

TEST_F(LiveCalibration, NamesTheCornerThatShowsNoDots) {
    // Dots are visible in only 60 to 70 % of the area of each frame.
    simulate("--frames 12 --covered 0.6,0.7");
    calibrate("frames");
    const std::regex advice("next: show dots in the [a-z ]*(corner|edge|middle) of the image");
    EXPECT_TRUE(std::regex_search(errors_, advice)) << errors_;
}

TEST_F(LiveCalibration, TakesFramesOfARobotThatDoesNotStop) {
    const Drive drive;
    const DriveCamera camera(188, 120);
    std::ofstream raw(directory_ / "drive.raw", std::ios::binary);
    constexpr int kFirst = 180;  // the robot is already moving in this frame
    constexpr int kStep = 5;
    for (int i = kFirst; i < kFirst + 60 * kStep; i += kStep) {
        const GreyImage image = camera.frame(drive, i);
        raw.write(reinterpret_cast<const char*>(image.pixels.data()),
                  static_cast<std::streamsize>(image.pixels.size()));
    }
    raw.close();
    // At 10 frames per second, the drive takes 6 s. After 3 s without a frame at rest, the program
    // also accepts frames that show motion.
    EXPECT_EQ(calibrate("--size 188x120 --fps 10 - <drive.raw"), 0) << errors_;
    EXPECT_TRUE(has_file());
    EXPECT_GE(used(), 10);
    // At 30 frames per second, the drive takes only 2 s. It ends before the program accepts frames
    // that show motion, so no frame is accepted.
    fs::remove(directory_ / "camera.yaml");
    EXPECT_EQ(calibrate("--size 188x120 --fps 30 - <drive.raw"), 1);
    EXPECT_FALSE(has_file());
    EXPECT_THAT(errors_, HasSubstr(" and 0 taken (0 out of focus, "));
}

/// Returns shell commands that calibrate with frames from a pipe that stays open, and send SIGINT
/// after the program has accepted `frames` frames.
std::string interrupted_after(int frames) {
    return fmt::format(
        "mkfifo pipe; touch told; (cat resting.raw; exec sleep 60) > pipe & writer=$!\n"
        "\"$T\" calibrate --live --no-window --size 188x120 --fps 90 - -o camera.yaml "
        "< pipe 2> told > report & tool=$!\n"
        "until grep -q '{} frames taken' told || ! kill -0 $tool; do sleep 0.05; done\n"
        "kill -INT $tool; wait $tool; status=$?; kill $writer; cat report; cat told >&2; "
        "(exit $status)",
        frames);
}

TEST_F(LiveCalibration, AnInterruptUsesWhatWasTaken) {
    simulate("--frames 7");
    put_raw("resting.raw");
    ASSERT_EQ(shell(interrupted_after(7)), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("frames      7 of 7 located"));
    EXPECT_THAT(errors_, HasSubstr("the calibration can be used, but could be improved: move "
                                   "to new places (uncertainty in the corner "));
    expect_paper_lens();
}

TEST_F(LiveCalibration, AnInterruptWritesNothingIfThatIsTooLittle) {
    simulate("--frames 4");
    put_raw("resting.raw");
    ASSERT_EQ(shell(interrupted_after(4)), 1) << errors_;
    EXPECT_FALSE(has_file());
    EXPECT_THAT(
        errors_,
        HasSubstr("and 4 taken (0 out of focus, 4 moving); missing: take more frames (4 of 5)"));
}

TEST_F(LiveCalibration, ShowsTheImageOnATerminal) {
    simulate("--frames 12");
    // `script` runs the tool on a pseudo-terminal.
    ASSERT_EQ(shell("script -qec \"$T calibrate --live --no-window frames -o camera.yaml\" "
                    "/dev/null </dev/null"),
              0)
        << output_;
    EXPECT_THAT(output_, HasSubstr("########################   image       100 %"));
    EXPECT_THAT(output_, HasSubstr("1 frame taken"));
    EXPECT_THAT(output_, HasSubstr("next  "));
    EXPECT_THAT(output_, HasSubstr("\033[11A"));
    EXPECT_THAT(output_, Not(HasSubstr("dotpose: 1 frame taken")));
    EXPECT_TRUE(has_file());
}

TEST_F(LiveCalibration, RefusesWhatItCannotDo) {
    EXPECT_EQ(run("calibrate --live -o camera.yaml"), 2);
    EXPECT_THAT(errors_, HasSubstr("no frames given"));
    simulate("--frames 2");
    for (const std::string other : {"--spin frames", "--drive frames"}) {
        EXPECT_EQ(run("calibrate --live frames " + other), 2) << other;
        EXPECT_THAT(errors_, HasSubstr("cannot be given together")) << other;
    }
    EXPECT_EQ(run("calibrate --no-window frames"), 2);
    // The output path is checked before the first frame is taken.
    EXPECT_EQ(run("calibrate --live --no-window frames -o nowhere/camera.yaml"), 1);
    EXPECT_THAT(errors_, HasSubstr("nowhere/camera.yaml"));
    EXPECT_THAT(errors_, Not(HasSubstr("taken")));
    ASSERT_EQ(run("simulate -o frames/more --frames 1 --size 200x120"), 0);
    EXPECT_EQ(run("calibrate --live --no-window frames frames/more -o camera.yaml"), 2);
    EXPECT_THAT(errors_, HasSubstr("frames of different sizes, 188 x 120 and 200 x 120 px"));
    ASSERT_EQ(shell("mkdir alone && cp \"$T\" alone/dotpose"), 0);
    EXPECT_EQ(shell("alone/dotpose calibrate --live frames"), 1);
    EXPECT_THAT(errors_, HasSubstr("calibrate --live needs the program dotpose-live"));
}

}  // namespace
}  // namespace dotpose::test
