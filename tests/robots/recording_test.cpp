// Tests recording and replaying a simulated drive over two sheets. Compares the messages with the
// output lines of the same run.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../blackbox/watch_command.hpp"
#include "../space_frames.hpp"
#include "drive_messages.hpp"
#include "npm_readers.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

class Recording : public WatchCommand {
  protected:
    using ToolCommand::shell;

    /// Records frames from a pipe. When the tool has processed `frames` frames, sends `signal` to
    /// it. Returns the exit code of the tool.
    int stop_after(int frames, const std::string& signal) {
        return shell("mkfifo frames; : >lines; \"$T\" watch - " + std::string(kRaw) + " " + kTrack +
                     " --no-window --mcap run.mcap -o lines <frames & tool=$!; exec 3>frames; "
                     "cat drive.raw >&3; until [ \"$(cat lines | wc -l)\" = " +
                     std::to_string(frames) + " ] || ! kill -0 $tool; do sleep 0.1; done; kill -" +
                     signal + " $tool; wait $tool");
    }

    std::vector<json> recorded(const std::string& name, const std::string& option = "") {
        return read_mcap((directory_ / name).string(), option);
    }
};

// A single test checks the poses, the odometry and the replayed log, because locating the drive and
// reading its recording take seconds.
TEST_F(Recording, HasThePosesAndTheOdometryOfTheLines) {
    DOTPOSE_NEEDS_NPM();
    put_raw(drive_.frames());
    ASSERT_EQ(run(std::string("watch - ") + kRaw + " " + kTrack +
                      " --units ros --log run.csv --mcap run.mcap --robot anna",
                  "drive.raw"),
              0)
        << errors_;
    const auto lines = parsed(output_);
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(drive_.frames()));
    const auto messages = recorded("run.mcap");
    expect_messages_of(lines, messages, "anna", kAsWatched);
    expect_odometry_of(lines, messages, "anna");

    // The numbers in the log are rounded, so the tolerance is larger for poses that are replayed
    // from it.
    ASSERT_EQ(run("replay run.csv -o again.mcap --robot anna"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("frames with a fix "));
    expect_messages_of(lines, recorded("again.mcap"), "anna", kAsLogged);
}

TEST_F(Recording, WithoutSheetsTheMapIsThePattern) {
    DOTPOSE_NEEDS_NPM();
    put_raw(20);
    ASSERT_EQ(run(std::string("watch - ") + kRaw +
                      " --code anoto --units ros --mcap run.mcap --robot 'Robot 7'",
                  "drive.raw"),
              0);
    const auto lines = parsed(output_);
    const auto poses = of_topic(recorded("run.mcap"), "/Robot_7/pose");
    ASSERT_EQ(poses.size(), 20U);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const json& position = poses[i]["message"]["pose"]["pose"]["position"];
        EXPECT_NEAR(position["x"], lines[i]["x_pattern_m"].get<double>(), 1e-9);
        EXPECT_NEAR(position["y"], lines[i]["y_pattern_m"].get<double>(), 1e-9);
    }
}

TEST_F(Recording, HasTheFramesIfAskedFor) {
    DOTPOSE_NEEDS_NPM();
    put_raw(5);
    ASSERT_EQ(run(std::string("watch - ") + kRaw + " " + kTrack + " --mcap run.mcap --mcap-images",
                  "drive.raw"),
              0);
    const auto images = of_topic(recorded("run.mcap"), "/robot/image/compressed");
    ASSERT_EQ(images.size(), 5U);
    const json& message = images[3]["message"];
    EXPECT_EQ(message["format"], "png");
    EXPECT_EQ(message["header"]["frame_id"], "camera_optical");
    // The recorded image is decoded by another program. It must have the same pixels as the frame.
    const auto bytes = message["data"].get<std::vector<std::uint8_t>>();
    std::ofstream(directory_ / "frame.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    ASSERT_EQ(shell("ffmpeg -v error -i frame.png -f rawvideo -pix_fmt gray frame.raw"), 0);
    const std::size_t size = std::size_t{kWidth} * kHeight;
    EXPECT_TRUE(file("frame.raw") == file("drive.raw").substr(3 * size, size));
}

TEST_F(Recording, TellsWhereTheCameraSits) {
    DOTPOSE_NEEDS_NPM();
    put_raw(3);
    std::ofstream(directory_ / "camera.yaml")
        << "{format: dotpose-camera, version: 1, width_px: 320, height_px: 240, k_per_px2: 0, "
           "centre_px: [159.5, 119.5], mm_per_px: [0.0458, 0.0458], reference_px: [59.5, 119.5]}";
    ASSERT_EQ(
        run(std::string("watch - ") + kRaw + " " + kTrack + " --camera camera.yaml --mcap run.mcap",
            "drive.raw"),
        0)
        << errors_;
    const auto mounts = of_topic(recorded("run.mcap"), "/tf_static");
    ASSERT_EQ(mounts.size(), 1U);
    const json& mount = mounts[0]["message"]["transforms"][0];
    EXPECT_EQ(mount["child_frame_id"], "camera_optical");
    EXPECT_NEAR(mount["transform"]["translation"]["x"], 0.00458, 1e-9);
    // `ros2 bag play` publishes the topic with the recorded quality of service. The recorded
    // durability must be transient local because transform listeners require it.
    EXPECT_THAT(mounts[0]["offered"], HasSubstr("\n  durability: 1\n"));
    const auto poses = of_topic(recorded("run.mcap"), "/robot/pose");
    EXPECT_THAT(poses.at(0)["offered"], HasSubstr("\n  durability: 2\n"));
}

TEST_F(Recording, HasThePosesInSpaceOfTheCamera) {
    DOTPOSE_NEEDS_NPM();
    write_space_frames(directory_);
    ASSERT_EQ(run("watch - --size 320x240 --fps 10 --sheets sheets.json --camera camera.yaml "
                  "--pose space --log run.csv -o run.json --mcap run.mcap --robot anna",
                  "space.raw"),
              0)
        << errors_;
    expect_true_space_poses(recorded("run.mcap"));
    // Replayed logs contain the same poses.
    for (const char* log : {"run.csv", "run.json"}) {
        ASSERT_EQ(run(std::string("replay ") + log + " -o again.mcap --robot anna"), 0) << errors_;
        expect_true_space_poses(recorded("again.mcap"));
    }
}

TEST_F(Recording, RobotsMayHaveFramesOfTheirOwn) {
    DOTPOSE_NEEDS_NPM();
    put_raw(20);
    ASSERT_EQ(run(std::string("watch - ") + kRaw + " " + kTrack +
                      " --log run.csv --frame-prefix anna/ --mcap run.mcap",
                  "drive.raw"),
              0)
        << errors_;
    ASSERT_EQ(run("replay run.csv --frame-prefix anna/ -o replayed.mcap"), 0) << errors_;
    for (const char* name : {"run.mcap", "replayed.mcap"}) {
        const auto messages = recorded(name);
        const json pose = of_topic(messages, "/robot/pose").at(0)["message"];
        EXPECT_EQ(pose["header"]["frame_id"], "map");
        const json odometry = of_topic(messages, "/robot/odom").at(0)["message"];
        EXPECT_EQ(odometry["header"]["frame_id"], "anna/odom");
        EXPECT_EQ(odometry["child_frame_id"], "anna/base_link");
    }
    EXPECT_EQ(run("replay run.csv --frame-prefix /anna/ -o replayed.mcap"), 2);
    EXPECT_THAT(errors_, HasSubstr("begins with a slash"));
}

TEST_F(Recording, KilledItIsStillReadable) {
    DOTPOSE_NEEDS_NPM();
    put_raw(400);
    ASSERT_EQ(stop_after(400, "KILL"), 128 + 9);
    // The tool has processed 2 s of frames. The last chunk of the file, which contains at most one
    // second, may be missing. The readers must accept the file nevertheless.
    const auto poses = of_topic(recorded("run.mcap"), "/robot/pose");
    EXPECT_GE(poses.size(), 199U);
    EXPECT_LE(poses.size(), 400U);
}

TEST_F(Recording, StoppedItIsComplete) {
    DOTPOSE_NEEDS_NPM();
    put_raw(100);
    ASSERT_EQ(stop_after(100, "INT"), 0);
    EXPECT_EQ(of_topic(recorded("run.mcap"), "/robot/pose").size(), 100U);
}

TEST_F(Recording, NeverReplacesAnInput) {
    put_raw(1);
    const std::string sheets = file("sheets.json");
    EXPECT_EQ(run(std::string("watch - ") + kRaw + " --sheets sheets.json --mcap sheets.json",
                  "drive.raw"),
              2);
    EXPECT_THAT(errors_, HasSubstr("--mcap sheets.json would overwrite the input --sheets"));
    EXPECT_EQ(file("sheets.json"), sheets);
    EXPECT_EQ(run("watch - --size 320x240 --mcap drive.avi", "drive.raw"), 2);
    EXPECT_THAT(errors_, HasSubstr("would contain a recording (MCAP)"));
    EXPECT_EQ(run("watch - --size 320x240 --mcap-images", "drive.raw"), 2);
    EXPECT_THAT(errors_, HasSubstr("--mcap-images needs a file"));
    std::ofstream(directory_ / "run.mcap") << "frame,t_s\n";
    EXPECT_EQ(run("replay run.mcap -o run.mcap"), 2);
    EXPECT_THAT(errors_, HasSubstr("would overwrite the input"));
}

TEST_F(Recording, OfALogWithATimeThatNoMessageHasIsRefused) {
    std::ofstream(directory_ / "run.csv")
        << "frame,t_s,file,status,dots_seen,p_wrong,state,events,verdict,plane,track_x_mm,"
           "track_y_mm,vx_mm_s,vy_mm_s\n"
           "0,-1,,no_contrast,0,,lost,,none,,,,,\n";
    EXPECT_EQ(run("replay run.csv -o run.mcap"), 1);
    EXPECT_THAT(errors_, HasSubstr("run.csv:2"));
    EXPECT_THAT(errors_, HasSubstr("t_s -1"));
}

}  // namespace
}  // namespace dotpose::test
