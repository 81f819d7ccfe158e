// Tests the camera pose in space that another program receives from `dotpose watch --mqtt`.
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../space_frames.hpp"
#include "mqtt_fixture.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;

std::vector<json> json_lines(const std::string& text) {
    std::vector<json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(json::parse(line));
    return lines;
}

class SpaceState : public Mqtt {
  protected:
    /// Runs `dotpose watch` on the frames of space_frames.hpp, and returns the states that
    /// mosquitto_sub receives.
    std::vector<json> states(const std::string& watch_options) {
        Broker broker(directory_);
        const std::string reader =
            fmt::format("mosquitto_sub -h 127.0.0.1 -p {} -c -i reader -q 1 -t '{}' ",
                        broker.port(), "uagv/v2/dotpose/anna/visualization");
        shell(reader + "-E");
        write_space_frames(directory_);
        EXPECT_EQ(run("watch - --size 320x240 --fps 10 -o lines --robot anna --qos 1 --mqtt " +
                          broker.url() + " " + watch_options,
                      (directory_ / "space.raw").string()),
                  0)
            << errors_;
        return json_lines(shell(fmt::format("{} -C {} -W 10", reader, kSpaceTilts_rad.size())));
    }
};

TEST_F(SpaceState, HasThePoseOfTheCameraInTheWorld) {
    save_drive_sheets(directory_ / "sheets.json");
    const auto received = states("--sheets sheets.json --camera camera.yaml --pose space");
    ASSERT_EQ(received.size(), kSpaceTilts_rad.size());
    for (std::size_t i = 0; i < received.size(); ++i) {
        const json& pose = received[i]["cameraPose"];
        expect_true_space_pose(i, pose, pose["orientation"], pose["covariance"]);
        const json& track = received[i]["cameraTrack"];
        expect_true_space_pose(i, track, track["orientation"], track["covariance"]);
    }
    // The camera moves along the x axis of the world, and rotates about the negative image y axis.
    const json& track = received.back()["cameraTrack"];
    EXPECT_GT(track["velocity"]["x"], 0.03);
    EXPECT_NEAR(track["turn"]["y"], -1.5, 0.2);
}

TEST_F(SpaceState, HasTheAxesOfThePatternWithoutSheets) {
    const auto received = states("--code anoto --camera camera.yaml --pose space");
    const auto lines = json_lines(file("lines"));
    ASSERT_EQ(received.size(), lines.size());
    for (std::size_t i = 0; i < received.size(); ++i) {
        const json& pose = received[i]["cameraPose"];
        const json& line = lines[i];
        EXPECT_NEAR(pose["x"], line["camera_x_mm"].get<double>() / 1000, 1e-9);
        EXPECT_NEAR(pose["y"], line["camera_y_mm"].get<double>() / 1000, 1e-9);
        EXPECT_NEAR(pose["z"], line["camera_z_mm"].get<double>() / 1000, 1e-9);
        const json& rotation = line["camera_quaternion_xyzw"];
        EXPECT_NEAR(pose["orientation"]["x"], rotation[0].get<double>(), 1e-8);
        EXPECT_NEAR(pose["orientation"]["y"], rotation[1].get<double>(), 1e-8);
        EXPECT_NEAR(pose["orientation"]["z"], rotation[2].get<double>(), 1e-8);
        EXPECT_NEAR(pose["orientation"]["w"], rotation[3].get<double>(), 1e-8);
        for (std::size_t k = 0; k < 3; ++k) {
            const double variance_mm2 = line["camera_covariance_mm_deg"][7 * k];
            EXPECT_NEAR(pose["covariance"][7 * k], variance_mm2 * 1e-6, variance_mm2 * 1e-9);
        }
        const json& track = received[i]["cameraTrack"];
        EXPECT_NEAR(track["y"], line["camera_track_y_mm"].get<double>() / 1000, 1e-9);
        EXPECT_NEAR(track["z"], line["camera_track_z_mm"].get<double>() / 1000, 1e-9);
        EXPECT_NEAR(track["velocity"]["z"], line["camera_vz_mm_s"].get<double>() / 1000, 1e-6);
        EXPECT_NEAR(track["turn"]["y"],
                    line["camera_turn_deg_s"][1].get<double>() * std::numbers::pi / 180, 1e-4);
    }
}

TEST_F(SpaceState, HasNoPoseInSpaceUnlessAskedFor) {
    for (const json& state : states("--code anoto --camera camera.yaml"))
        EXPECT_FALSE(state.contains("cameraPose") || state.contains("cameraTrack"));
}

}  // namespace
}  // namespace dotpose::test
