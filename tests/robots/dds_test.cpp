// Tests the messages of `dotpose watch --dds`. Another DDS implementation receives them in a
// separate network namespace, and an independent reader decodes them.
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

#ifdef DOTPOSE_DDS_READER
constexpr const char* kReader = DOTPOSE_DDS_READER;
#else
constexpr const char* kReader = nullptr;
#endif

constexpr const char* kTopics =
    "/anna/pose geometry_msgs/PoseWithCovarianceStamped /anna/odom nav_msgs/Odometry "
    "/anna/status diagnostic_msgs/DiagnosticArray /tf tf2_msgs/TFMessage";

/// Shell commands that set up a network with only the loopback interface, and enable the multicast
/// that DDS needs.
constexpr const char* kNetwork =
    "ip link set lo up multicast on; ip route add 239.0.0.0/8 dev lo; ";

class Dds : public WatchCommand {
  protected:
    using ToolCommand::shell;

    /// Returns true if network namespaces can be created, which is impossible in most containers.
    static bool has_networks() {
        return run_shell(std::string("unshare -rn sh -c '") + kNetwork + "' 2>&1").exit_code == 0;
    }

    /// Starts a message reader, and then runs `dotpose watch` on the frames that the shell command
    /// `frames` writes. Returns the messages that the reader received.
    std::vector<json> read_drive(const std::string& frames, const std::string& reliability,
                                 const std::string& options, const std::string& environment = "",
                                 const std::string& topics = kTopics,
                                 const std::string& raw = kRaw) {
        const std::string watch = "'" + test::tool_path() + "' watch - " + raw + " " + kTrack +
                                  " --units ros --dds --robot anna -o lines " + options;
        // Frames are sent only after the reader has reported that it and the writers have
        // discovered each other.
        const std::string ready =
            "until [ -e ready ] || ! kill -0 $reader; do sleep 0.1; done; sleep 1; ";
        std::ofstream(directory_ / "run.sh")
            << kNetwork << environment << "'" << kReader << "' " << reliability << " ready "
            << topics << " >samples 2>reader.txt & reader=$!\n"
            << "(" << ready << frames << ") | " << watch << " 2>watch.txt\n"
            << "wait $reader\n";
        EXPECT_EQ(shell("unshare -rn sh run.sh"), 0) << errors_;
        EXPECT_EQ(file("reader.txt"), "");
        EXPECT_THAT(file("watch.txt"), HasSubstr("published over DDS, 0 dropped"));
        const ShellOutcome decoded =
            run_node("decode.mjs <'" + (directory_ / "samples").string() + "' 2>&1");
        EXPECT_EQ(decoded.exit_code, 0) << decoded.output.substr(0, 2000);
        return parsed(decoded.output);
    }
};

#define DOTPOSE_NEEDS_DDS()                                                                  \
    DOTPOSE_NEEDS_NPM();                                                                     \
    if (kReader == nullptr) GTEST_SKIP() << "built without Cyclone DDS or without Fast DDS"; \
    if (!has_networks()) GTEST_SKIP() << "no network namespaces here"

TEST_F(Dds, HasThePosesOfTheLines) {
    DOTPOSE_NEEDS_DDS();
    put_raw(drive_.frames());
    // The frames are sent without pauses, and no message may be lost.
    const auto messages = read_drive("cat drive.raw", "reliable", "--dds-reliable");
    expect_messages_of(parsed(file("lines")), messages, "anna", kAsWatched);
}

TEST_F(Dds, SendsSensorDataAsRosDoes) {
    DOTPOSE_NEEDS_DDS();
    put_raw(200);
    const auto messages = read_drive(
        "ffmpeg -v error -readrate 0.5 -f rawvideo -pix_fmt gray -s 320x240 -r 200 -i drive.raw "
        "-f rawvideo -",
        "best-effort", "");
    // An otherwise idle loopback interface usually loses no messages, but this is not guaranteed.
    EXPECT_GT(of_topic(messages, "/anna/pose").size(), 150U);
    EXPECT_EQ(of_topic(messages, "/tf").size(), 200U);
}

TEST_F(Dds, IsFoundOnThisComputerAloneIfRosSaysSo) {
    DOTPOSE_NEEDS_DDS();
    put_raw(20);
    // With LOCALHOST, `dotpose watch` and the reader must discover each other without multicast.
    const auto messages = read_drive("cat drive.raw", "reliable", "--dds-reliable",
                                     "export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST; ");
    EXPECT_EQ(of_topic(messages, "/anna/pose").size(), 20U);
}

TEST_F(Dds, HasThePosesInSpaceOfTheCamera) {
    DOTPOSE_NEEDS_DDS();
    write_space_frames(directory_);
    const auto messages = read_drive(
        "cat space.raw", "reliable", "--dds-reliable --camera camera.yaml --pose space", "",
        std::string(kTopics) +
            " /anna/camera_pose geometry_msgs/PoseWithCovarianceStamped /anna/camera_odom "
            "nav_msgs/Odometry",
        "--size 320x240 --fps 10");
    expect_true_space_poses(messages);
}

TEST_F(Dds, RefusesDomainsThatDoNotExist) {
    put_raw(1);
    EXPECT_EQ(run("watch - --size 320x240 --dds --dds-domain 233", "drive.raw"), 2);
    if (kReader == nullptr) return;
    EXPECT_EQ(shell("ROS_DOMAIN_ID=many \"$T\" watch - --size 320x240 --dds <drive.raw"), 2);
    EXPECT_THAT(errors_, HasSubstr("ROS_DOMAIN_ID is 'many'"));
}

}  // namespace
}  // namespace dotpose::test
