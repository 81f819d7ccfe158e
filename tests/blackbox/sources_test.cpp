// Tests that all commands accept the same sources of frames, and give the same results for the same
// frames.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class Sources : public ToolCommand {
  protected:
    static constexpr int kFrames = 6;

    /// Writes simulated frames to the folder `frames`, and losslessly encodes the same frames to
    /// drive.mkv and drive.raw.
    void SetUp() override {
        ASSERT_EQ(run("simulate -o frames --seed 91 --frames " + std::to_string(kFrames)), 0);
        ASSERT_EQ(encode("-c:v ffv1 drive.mkv"), 0) << errors_;
        ASSERT_EQ(encode("-f rawvideo -pix_fmt gray drive.raw"), 0) << errors_;
    }

    int encode(const std::string& options) {
        return shell("ffmpeg -v error -framerate 30 -i frames/frame_%06d.pgm " + options);
    }

    std::vector<json> records() const {
        std::vector<json> all;
        std::istringstream stream(output_);
        for (std::string line; std::getline(stream, line);)
            all.push_back(json::parse(line));
        return all;
    }

    std::vector<std::string> files() const {
        std::vector<std::string> all;
        for (const json& record : records())
            all.push_back(record["file"]);
        return all;
    }

    /// Returns the output lines of the last run, without the fields that depend on the source or
    /// the time.
    std::vector<json> poses() const {
        std::vector<json> all = records();
        for (json& record : all) {
            record.erase("file");
            record.erase("elapsed_us");
        }
        return all;
    }

    static std::string image(int i) { return "frames/frame_00000" + std::to_string(i) + ".pgm"; }
};

TEST_F(Sources, LocateGivesTheSameOfEachOfThem) {
    ASSERT_EQ(run("locate frames/*.pgm"), 0) << errors_;
    const std::vector<json> expected = poses();
    ASSERT_EQ(expected.size(), std::size_t{kFrames});
    const std::vector<std::string> images = files();
    EXPECT_EQ(images.front(), image(0));
    for (const std::string source : {"frames", "'frames/*.pgm'"}) {
        EXPECT_EQ(run("locate " + source), 0) << errors_;
        EXPECT_EQ(poses(), expected) << source;
        EXPECT_EQ(files(), images) << source;
    }
    EXPECT_EQ(run("locate drive.mkv"), 0) << errors_;
    EXPECT_EQ(poses(), expected);
    EXPECT_THAT(files(), ElementsAre("drive.mkv#0", "drive.mkv#1", "drive.mkv#2", "drive.mkv#3",
                                     "drive.mkv#4", "drive.mkv#5"));
    EXPECT_EQ(run("locate - --size 188x120", "drive.raw"), 0) << errors_;
    EXPECT_EQ(poses(), expected);
    EXPECT_EQ(files().at(5), "-#5");
}

TEST_F(Sources, AreReadInTheirOrderAndOneThatFailsIsPassedOver) {
    std::ofstream(directory_ / "list") << image(2) << "\ndrive.mkv\nnowhere.mp4\n"
                                       << image(4) << "\n";
    const auto expect_all = [&] {
        EXPECT_EQ(exit_code_, 1);
        EXPECT_EQ(errors_, "dotpose: cannot read nowhere.mp4: no such file or camera\n");
        const std::vector<std::string> names = files();
        ASSERT_EQ(names.size(), std::size_t{kFrames + 2});
        EXPECT_EQ(names.front(), image(2));
        EXPECT_EQ(names[1], "drive.mkv#0");
        EXPECT_EQ(names.back(), image(4));
    };
    run("locate --list list");
    expect_all();
    run("locate --list -", "list");
    expect_all();
    shell("cat list | \"$T\" locate --list -");
    expect_all();
}

TEST_F(Sources, AVideoIsKnownByItsFirstBytesToo) {
    fs::rename(directory_ / "drive.mkv", directory_ / "drive");
    EXPECT_EQ(run("locate drive"), 0) << errors_;
    EXPECT_EQ(files().size(), std::size_t{kFrames});
}

TEST_F(Sources, PicturesAreNamedAfterTheFrames) {
    EXPECT_EQ(run("locate drive.mkv --draw pictures"), 0) << errors_;
    EXPECT_THAT(file("pictures/drive-0.svg"), HasSubstr("</svg>"));
    EXPECT_THAT(file("pictures/drive-5.svg"), HasSubstr("drive.mkv#5"));
}

TEST_F(Sources, WatchGoesOnFromOneToTheNext) {
    ASSERT_EQ(run("watch frames --no-window"), 0) << errors_;
    const std::vector<json> whole = records();
    ASSERT_EQ(whole.size(), std::size_t{kFrames});
    ASSERT_EQ(run("watch --no-window frames/*.pgm"), 0) << errors_;
    EXPECT_EQ(records(), whole);
    ASSERT_EQ(run("watch --no-window drive.mkv drive.mkv " + image(0)), 0) << errors_;
    const std::vector<json> both = records();
    ASSERT_EQ(both.size(), std::size_t{2 * kFrames + 1});
    for (std::size_t i = 0; i < both.size(); ++i) {
        EXPECT_EQ(both[i]["frame"], i);
        EXPECT_NEAR(both[i]["t_s"], static_cast<double>(i) / 30, 0.002);
        EXPECT_EQ(both[i]["x_grid"], whole[i % kFrames]["x_grid"]);
    }
    EXPECT_FALSE(both[0].contains("file"));
    EXPECT_EQ(both.back()["file"], image(0));
}

TEST_F(Sources, EvaluateFindsThePosesOfImagesByNameAndOfFramesByNumber) {
    const auto score = [this](const std::string& arguments) {
        EXPECT_EQ(run("evaluate --format json " + arguments), 0) << errors_;
        json all = json::parse(output_);
        all.erase("elapsed_us");
        return all;
    };
    const json expected = score("frames");
    EXPECT_EQ(expected["frames"], kFrames);
    EXPECT_EQ(expected["located"], kFrames);
    EXPECT_EQ(expected["wrong"], 0);
    EXPECT_EQ(score("frames/*.pgm"), expected);
    EXPECT_EQ(score("drive.mkv --poses frames/truth.csv"), expected);
    fs::copy_file(directory_ / "frames/truth.csv", directory_ / "truth.csv");
    EXPECT_EQ(score("drive.mkv"), expected);
    EXPECT_EQ(score("--size 188x120 - <drive.raw"), expected);
    const json two = score(image(4) + " " + image(1));
    EXPECT_EQ(two["frames"], 2);
    EXPECT_EQ(two["wrong"], 0);
}

TEST_F(Sources, EvaluateSaysWhichPosesAreMissing) {
    EXPECT_EQ(run("evaluate drive.mkv"), 1);
    EXPECT_THAT(errors_, HasSubstr("truth.csv"));
    fs::copy_file(directory_ / image(0), directory_ / "frames/other.pgm");
    EXPECT_EQ(run("evaluate frames/other.pgm"), 1);
    EXPECT_EQ(errors_, "dotpose: frames/truth.csv has no pose of frames/other.pgm\n");
    // The file more.csv has more rows than the video has frames, and less.csv has fewer rows.
    const std::string truth = file("frames/truth.csv");
    std::ofstream(directory_ / "more.csv") << truth << truth.substr(truth.find('\n') + 1);
    EXPECT_EQ(run("evaluate drive.mkv --format json --poses more.csv"), 1);
    EXPECT_THAT(errors_, HasSubstr("there is no frame 6"));
    EXPECT_EQ(json::parse(output_)["located"], kFrames);
    std::ofstream(directory_ / "less.csv")
        << truth.substr(0, truth.rfind('\n', truth.size() - 2) + 1);
    EXPECT_EQ(run("evaluate drive.mkv --format json --poses less.csv"), 0);
    EXPECT_THAT(errors_, HasSubstr("there are more frames than the 5 poses"));
}

TEST_F(Sources, ThatNeedTheOtherProgramSayWhichIsMissing) {
    ASSERT_EQ(shell("mkdir alone && cp \"$T\" alone/dotpose"), 0);
    const std::string missing = "the program dotpose-live, and " +
                                (directory_ / "alone/dotpose-live").string() +
                                " cannot be started: No such file or directory";
    for (const std::string command : {"locate drive.mkv", "calibrate drive.mkv", "watch drive.mkv",
                                      "evaluate drive.mkv", "locate 0"}) {
        EXPECT_EQ(shell("alone/dotpose " + command), 1) << command;
        EXPECT_THAT(errors_, HasSubstr(missing)) << command;
    }
    EXPECT_EQ(shell("printf 'frames\\ndrive.mkv\\n' | alone/dotpose locate --list -"), 1);
    EXPECT_THAT(errors_, StartsWith("dotpose: cannot read drive.mkv: "));
    EXPECT_THAT(errors_, HasSubstr(missing));
    EXPECT_EQ(records().size(), std::size_t{kFrames});
}

TEST_F(Sources, WrongOnesAreNamed) {
    for (const std::string command : {"locate", "watch", "evaluate", "calibrate"}) {
        EXPECT_EQ(run(command), 2) << command;
        EXPECT_EQ(run(command + " - --list -"), 2) << command;
        EXPECT_THAT(errors_, HasSubstr("standard input is named twice")) << command;
        EXPECT_EQ(run(command + " -"), 2) << command;
        EXPECT_THAT(errors_, HasSubstr("raw frames need their size: --size WxH")) << command;
        EXPECT_EQ(run(command + " 'nothing*.png'"), 1) << command;
        EXPECT_THAT(errors_, HasSubstr("no images at nothing*.png")) << command;
    }
    EXPECT_EQ(run("calibrate - --spin - --size 188x120"), 2);
    EXPECT_THAT(errors_, HasSubstr("standard input is named twice"));
    EXPECT_EQ(run("watch nowhere.png"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot read nowhere.png: no such file"));
    EXPECT_EQ(run("locate " + image(0) + " --roi 0,0,500x10"), 2);
    EXPECT_THAT(errors_, HasSubstr("leaves the frame of 188x120 px"));
}

// With --roi, `locate` processes only a region of each frame. The camera file still describes the
// whole frame, and the reported pose is still that of the whole frame's reference point.
TEST_F(Sources, APartOfAFrameIsLocatedWithTheCameraFileOfTheWhole) {
    std::ofstream(directory_ / "camera.yaml")
        << "{format: dotpose-camera, version: 1, width_px: 188, height_px: 120, k_per_px2: 0, "
           "centre_px: [93.5, 59.5], mm_per_px: [0.046, 0.046], reference_px: [40, 90], "
           "theta_offset_rad: 0.5}";
    const auto pose = [&](const std::string& options) {
        EXPECT_EQ(run("locate --camera camera.yaml " + options + image(0)), 0) << errors_;
        const json record = records().at(0);
        EXPECT_EQ(record["status"], "ok") << record;
        return record;
    };
    const json whole = pose("");
    const json part = pose("--roi 20,10,150x100 ");
    EXPECT_LT(part["dots_used"], whole["dots_used"]);
    EXPECT_NEAR(part["x_mm"], whole["x_mm"], 0.01);
    EXPECT_NEAR(part["y_mm"], whole["y_mm"], 0.01);
    EXPECT_NEAR(part["theta_deg"], whole["theta_deg"], 0.2);
    const json other = pose("--reference 93.5,59.5 ");
    EXPECT_GT(std::abs(other["x_mm"].get<double>() - whole["x_mm"].get<double>()), 0.02);
    const json other_part = pose("--reference 93.5,59.5 --roi 20,10,150x100 ");
    EXPECT_NEAR(other_part["x_mm"], other["x_mm"], 0.01);
    EXPECT_NEAR(other_part["y_mm"], other["y_mm"], 0.01);
    // The frames must have the size given in the camera file, and must contain the region.
    ASSERT_EQ(run("simulate -o large --size 200x120 --frames 1"), 0);
    EXPECT_EQ(run("locate --camera camera.yaml --roi 20,10,150x100 large"), 1);
    EXPECT_THAT(errors_, HasSubstr("frame_000000.pgm: the camera file is for images of 188 x 120 "
                                   "px, not 200 x 120 px"));
    EXPECT_EQ(run("locate --camera camera.yaml --roi 100,10,150x100 " + image(0)), 2);
    EXPECT_THAT(errors_, HasSubstr("leaves the camera's images of 188x120 px"));
}

TEST_F(Sources, AreFlippedForAllCommands) {
    ASSERT_EQ(shell("mkdir mirrored && cp frames/truth.csv mirrored && for frame in "
                    "frames/*.pgm; do ffmpeg -v error -i $frame -vf hflip "
                    "mirrored/${frame##*/}; done"),
              0)
        << errors_;
    for (const std::string command : {"locate", "watch"}) {
        ASSERT_EQ(run(command + " frames"), 0);
        const std::vector<json> straight = poses();
        ASSERT_EQ(run(command + " --flip mirrored"), 0);
        EXPECT_EQ(poses(), straight) << command;
    }
    ASSERT_EQ(run("evaluate --flip mirrored --format json"), 0);
    EXPECT_EQ(json::parse(output_)["located"], kFrames);
    EXPECT_EQ(run("calibrate mirrored -o camera.yaml"), 1);
    EXPECT_THAT(errors_, StartsWith("dotpose: the frames show the pattern mirrored: use --flip"));
    ASSERT_EQ(run("calibrate --flip mirrored -o camera.yaml"), 0) << errors_;
    EXPECT_THAT(file("camera.yaml"), HasSubstr("flip: true"));
    ASSERT_EQ(run("locate --camera camera.yaml mirrored"), 0);
    for (const json& record : records())
        EXPECT_EQ(record["status"], "ok");
}

/// Returns the value called `name` in the camera file, or -1 if there is none.
double value_of(const std::string& yaml, const std::string& name) {
    const std::size_t at = yaml.find(name + ": ");
    return at == std::string::npos ? -1 : std::stod(yaml.substr(at + name.size() + 2));
}

TEST_F(Sources, CalibrateChoosesTheFramesOfAVideoThatShowNewPlaces) {
    ASSERT_EQ(run("simulate -o frames --seed 91 --k -8.7e-6 --frames 12"), 0) << errors_;
    // Each frame is repeated three times, as if the camera were at rest.
    ASSERT_EQ(encode("-vf fps=90 -c:v ffv1 slow.mkv"), 0) << errors_;
    ASSERT_EQ(run("calibrate frames/*.pgm -o images.yaml"), 0) << errors_;
    ASSERT_EQ(run("calibrate slow.mkv -o video.yaml"), 0) << errors_;
    EXPECT_THAT(errors_, HasSubstr("slow.mkv: 36 of 36 frames located; 12 that show new places"));
    EXPECT_THAT(output_, HasSubstr("12 of 12 located"));
    EXPECT_EQ(value_of(file("video.yaml"), "k_per_px2"),
              value_of(file("images.yaml"), "k_per_px2"));
    EXPECT_NE(value_of(file("video.yaml"), "k_per_px2"), -1);
}

}  // namespace
}  // namespace dotpose::test
