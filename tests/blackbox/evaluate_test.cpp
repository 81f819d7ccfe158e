// Black-box tests of `dotpose evaluate`.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "dotpose/tools/image_file.hpp"
#include "sheets_command.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class EvaluateCommand : public ToolCommand {
  protected:
    json result() const { return json::parse(output_); }

    /// Replaces fields in the first data row of truth.csv. Each pair contains a column index and
    /// the new text.
    void tamper(const std::vector<std::pair<std::size_t, std::string>>& cells) const {
        std::istringstream truth(file("frames/truth.csv"));
        std::ofstream out(directory_ / "frames/truth.csv");
        std::string line;
        for (int number = 0; std::getline(truth, line); ++number) {
            if (number == 1) line = replaced(line, cells);
            out << line << '\n';
        }
    }

  private:
    static std::string replaced(const std::string& line,
                                const std::vector<std::pair<std::size_t, std::string>>& cells) {
        std::vector<std::string> row;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');)
            row.push_back(cell);
        for (const auto& [column, text] : cells)
            row.at(column) = text;
        std::string result;
        for (const std::string& cell : row) {
            if (!result.empty()) result += ',';
            result += cell;
        }
        return result;
    }
};

/// Returns true if the picture is mostly light and contains some ink.
bool shows_something(const GreyImage& image) {
    const auto pixels = static_cast<std::ptrdiff_t>(image.pixels.size());
    const auto light = std::count_if(image.pixels.begin(), image.pixels.end(),
                                     [](std::uint8_t level) { return level >= 240; });
    return image.width_px > 1000 && 2 * light > pixels && 100 * light < 99 * pixels;
}

constexpr std::size_t kXGrid = 4;
constexpr std::size_t kSectionU = 6;

TEST_F(EvaluateCommand, AFolderGivesTheNumbersOfTheSameFramesInMemory) {
    ASSERT_EQ(run("simulate -o frames --frames 10 --seed 7"), 0) << errors_;
    ASSERT_EQ(run("evaluate frames --format json"), 0) << errors_;
    const json folder = result();
    EXPECT_EQ(folder["frames"], 10);
    EXPECT_EQ(folder["located"], 10);
    EXPECT_EQ(folder["wrong"], 0);
    EXPECT_GT(folder["position_um"]["median"], 0);
    EXPECT_LT(folder["position_um"]["max"], 10);
    ASSERT_EQ(run("evaluate --preset nominal --frames 10 --seed 7 --format json"), 0) << errors_;
    const json memory = result();
    EXPECT_EQ(memory["located"], folder["located"]);
    // The two results differ slightly, because truth.csv contains positions in grid spacings,
    // rounded to 8 decimal places.
    EXPECT_NEAR(memory["position_um"]["median"], folder["position_um"]["median"], 1e-4);
    EXPECT_NEAR(memory["angle_deg"]["max"], folder["angle_deg"]["max"], 1e-6);
}

TEST_F(EvaluateCommand, ATamperedPositionOrSectionIsAWrongFix) {
    ASSERT_EQ(run("simulate -o frames --frames 3 --section 3,4"), 0) << errors_;
    tamper({{kXGrid, "12345"}});
    ASSERT_EQ(run("evaluate frames --format json"), 0) << errors_;
    EXPECT_EQ(result()["wrong"], 1);
    EXPECT_EQ(result()["located"], 2);
    ASSERT_EQ(run("simulate -o frames --frames 3 --section 3,4"), 0) << errors_;
    tamper({{kSectionU, "5"}});
    ASSERT_EQ(run("evaluate frames --format json"), 0) << errors_;
    EXPECT_EQ(result()["wrong"], 1);
}

TEST_F(EvaluateCommand, FramesWithoutFixAreShownByStatusAndAreNoFailure) {
    ASSERT_EQ(run("simulate -o frames --frames 2 --scene white"), 0) << errors_;
    ASSERT_EQ(run("evaluate frames"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("not located: "));
    EXPECT_THAT(output_, HasSubstr("0 (0.00 %)"));
    ASSERT_EQ(run("evaluate frames --format json"), 0);
    EXPECT_TRUE(result()["position_um"]["median"].is_null());
}

TEST_F(EvaluateCommand, ProfileAndSpacingAreTakenFromTheTruthUnlessGiven) {
    ASSERT_EQ(run("simulate -o frames --frames 2 --code microdots --spacing 0.6"), 0);
    ASSERT_EQ(run("evaluate frames --format json"), 0);
    EXPECT_EQ(result()["located"], 2);
    ASSERT_EQ(run("evaluate frames --code anoto --format json"), 0);
    EXPECT_EQ(result()["located"], 0);
}

TEST_F(EvaluateCommand, ACameraFileIsUsedAsLocateDoes) {
    ASSERT_EQ(run("simulate -o frames --frames 5 --k -8.7e-6 --angle 30 --at 5000,6000"), 0);
    // The robot's centre is 5 mm from the camera along the image x axis. The heading of the robot
    // is a quarter turn away from this axis.
    std::ofstream(directory_ / "robot.yaml")
        << "{format: dotpose-camera, version: 1, width_px: 188, height_px: 120, k_per_px2: "
           "-8.7e-06, centre_px: [93.5, 59.5], mm_per_px: [0.046, 0.046], reference_px: "
           "[202.195652, 59.5], theta_offset_rad: 1.570796327}";
    ASSERT_EQ(run("evaluate frames --k -8.7e-6 --format json"), 0) << errors_;
    const json lens_alone = result();
    ASSERT_EQ(run("evaluate frames --camera robot.yaml --format json"), 0) << errors_;
    const json image = result();
    EXPECT_EQ(image["located"], 5);
    EXPECT_LT(image["position_um"]["max"], 5);
    // With the scale and tilt from the camera file, the fit has five parameters. With only the lens
    // parameters from the file, the fit has eight, so the fitted angles are different.
    EXPECT_NE(image["angle_deg"]["max"], lens_alone["angle_deg"]["max"]);
    ASSERT_EQ(run("evaluate frames --camera robot.yaml --truth robot --format json"), 0) << errors_;
    EXPECT_EQ(result()["wrong"], 5);  // truth.csv contains the pose of the image centre

    std::ofstream truth(directory_ / "frames/truth.csv");
    truth << "file,theta_deg,x_grid,y_grid\n";
    constexpr double kAhead_grid = 5 / 0.508;
    const double x = 5000 + kAhead_grid * std::cos(std::numbers::pi / 6);
    const double y = 6000 + kAhead_grid * std::sin(std::numbers::pi / 6);
    for (int i = 0; i < 5; ++i)
        truth << "frame_00000" << i << ".pgm,120," << x << ',' << y << '\n';
    truth.close();
    ASSERT_EQ(run("evaluate frames --camera robot.yaml --truth robot --format json"), 0) << errors_;
    EXPECT_EQ(result()["located"], 5);
    // This limit is larger than the limit above for two reasons. The centre is 5 mm from the
    // camera, so an angle error of 0.03 degrees moves it by 3 µm. The coordinates in truth.csv have
    // only 6 significant digits, so each coordinate may be wrong by up to 3 µm.
    EXPECT_LT(result()["position_um"]["max"], 15);
    EXPECT_LT(result()["angle_deg"]["max"], 0.15);
}

TEST_F(EvaluateCommand, ACameraFileOfAnotherSizeIsAProblemOfEachImage) {
    ASSERT_EQ(run("simulate -o frames --frames 2"), 0);
    std::ofstream(directory_ / "large.yaml") << kLargeCamera;
    EXPECT_EQ(run("evaluate frames --camera large.yaml"), 1);
    EXPECT_THAT(errors_, HasSubstr(std::string("frame_000001.pgm") + kNotForLargeCamera));
    EXPECT_EQ(run("evaluate frames --truth robot"), 2);
    EXPECT_EQ(run("evaluate --preset clean --camera large.yaml"), 2);
}

TEST_F(EvaluateCommand, WhatCannotBeReadIsNamedAndTheRestIsDone) {
    EXPECT_EQ(run("evaluate nowhere"), 1);
    EXPECT_THAT(errors_, HasSubstr("nowhere"));
    ASSERT_EQ(run("simulate -o frames --frames 2"), 0);
    fs::remove(directory_ / "frames/frame_000001.pgm");
    EXPECT_EQ(run("evaluate frames --format json"), 1);
    EXPECT_THAT(errors_, HasSubstr("frame_000001.pgm"));
    EXPECT_EQ(result()["frames"], 1);
    EXPECT_EQ(result()["unreadable"], 1);
}

TEST_F(EvaluateCommand, TheProtocolWritesItsTableAndFigures) {
    ASSERT_EQ(run("evaluate --protocol paper --frames 1 -o out/deep"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("0.155 mm"));
    for (const char* name : {"table-3.md", "positions.csv", "angles.csv", "figure-13.svg",
                             "figure-14.svg", "figure-15.svg"}) {
        EXPECT_NE(file(std::string("out/deep/") + name), "") << name;
    }
    for (const char* name : {"figure-13.png", "figure-14.png", "figure-15.png"}) {
        EXPECT_TRUE(shows_something(read_image(directory_ / "out/deep" / name))) << name;
    }
}

/// Frames of a sheet. Each pose was measured twice: with a ruler, in the coordinates of the sheet,
/// and with a motion stage, in coordinates with a different origin, direction and unit.
class EvaluateMeasured : public EvaluateCommand {
  protected:
    void SetUp() override {
        ASSERT_EQ(run("print -o a.svg --paper 60x60 --sheets sheets.json --name table"), 0);
        const json sheet = json::parse(file("sheets.json"))["sheets"].at(0);
        std::ofstream by_ruler(directory_ / "ruler.csv");
        std::ofstream by_stage(directory_ / "stage.csv");
        by_ruler << "file,sheet,x_sheet_mm,y_sheet_mm,theta_sheet_deg\n";
        by_stage << "file,x_m,y_m,yaw_deg\n";
        for (int i = 0; i < 9; ++i) {
            const double x_mm = 15 + 15.0 * (i % 3);
            const double y_mm = 15 + 15.0 * (i / 3);
            const std::string name = "f" + std::to_string(i) + ".pgm";
            write_pgm(directory_ / name,
                      frame_of(sheet, x_mm, y_mm, 0.4 * i, static_cast<std::uint64_t>(i)).view());
            by_ruler << name << ",table," << x_mm << ',' << y_mm << ',' << 0.4 * i * kDegrees
                     << '\n';
            // The x axis of the stage is the y axis of the sheet, and the y axis of the stage is
            // the x axis of the sheet. The stage measures in metres, and its lengths are 0.3 % too
            // large.
            by_stage << name << ',' << 1.003 * y_mm / 1000 << ',' << 1.003 * x_mm / 1000 << ','
                     << 90 - 0.4 * i * kDegrees << '\n';
        }
    }
    static constexpr double kDegrees = 180 / std::numbers::pi;
};

TEST_F(EvaluateMeasured, OnTheSheetByARuler) {
    ASSERT_EQ(run("evaluate . --sheets sheets.json --poses ruler.csv --align none --format json"),
              0)
        << errors_;
    EXPECT_EQ(result()["located"], 9);
    EXPECT_EQ(result()["frame"], "sheet");
    EXPECT_FALSE(result().contains("alignment"));
    EXPECT_LT(result()["position_um"]["max"], 10);
    EXPECT_LT(result()["angle_deg"]["max"], 0.15);
    EXPECT_EQ(run("evaluate . --poses ruler.csv"), 1);
    EXPECT_THAT(errors_, HasSubstr("name the sheet file, --sheets"));
    std::ofstream(directory_ / "pattern.csv") << "file,x_mm,y_mm,theta_deg\nf0.pgm,1,2,3\n";
    EXPECT_EQ(run("evaluate . --sheets sheets.json --poses pattern.csv"), 1);
    EXPECT_THAT(errors_, HasSubstr("evaluate them without --sheets"));
    EXPECT_EQ(run("evaluate f0.pgm --poses ruler.csv --residuals r.csv"), 2);
    EXPECT_THAT(errors_, HasSubstr("--residuals needs --sheets"));
}

TEST_F(EvaluateMeasured, InTheWorldByAStage) {
    const std::string command = "evaluate . --sheets sheets.json --poses stage.csv ";
    EXPECT_EQ(run(command), 1);
    EXPECT_THAT(errors_, HasSubstr("'dotpose sheets place' first"));
    ASSERT_EQ(run("sheets place table --x 2 --y 1 --yaw 0"), 0);
    ASSERT_EQ(run(command + "--format json"), 0) << errors_;
    EXPECT_EQ(result()["located"], 9);
    const json by = result()["alignment"];
    EXPECT_NEAR(by["scale"].get<double>(), 1.003, 3e-4);
    EXPECT_NEAR(by["turn_rad"].get<double>(), std::numbers::pi / 2, 3e-4);
    EXPECT_LT(result()["position_um"]["max"], 10);
    ASSERT_EQ(run(command + "--residuals r.csv --draw figures"), 0) << errors_;
    EXPECT_THAT(output_, testing::ContainsRegex("alignment: scale, % +[+]0[.](29|30)"));
    EXPECT_THAT(file("r.csv"), testing::StartsWith("file,status,sheet,true_x_mm"));
    EXPECT_THAT(file("r.csv"), HasSubstr("\n./f8.pgm,ok,table,"));
    for (const char* figure : {"figure-13.png", "figure-14.png", "figure-15.png"}) {
        EXPECT_TRUE(shows_something(read_image(directory_ / "figures" / figure))) << figure;
    }
}

TEST_F(EvaluateCommand, ASweepWritesItsTableAndPicture) {
    ASSERT_EQ(run("evaluate --sweep tilt --frames 1 -o out"), 0) << errors_;
    EXPECT_THAT(file("out/sweep-tilt.csv"), testing::StartsWith("tilt,decoder,frames,located"));
    EXPECT_THAT(file("out/sweep-tilt.svg"), HasSubstr("</svg>"));
    EXPECT_TRUE(shows_something(read_image(directory_ / "out/sweep-tilt.png")));
}

TEST_F(EvaluateCommand, WrongUsageIsNamed) {
    EXPECT_EQ(run("evaluate"), 2);
    EXPECT_THAT(errors_, HasSubstr("--preset"));
    EXPECT_EQ(run("evaluate frames --preset hard"), 2);
    EXPECT_EQ(run("evaluate --preset nice"), 2);
    EXPECT_EQ(run("evaluate --sweep noise"), 2);
    EXPECT_THAT(errors_, HasSubstr("-o DIR"));
    EXPECT_EQ(run("evaluate --preset hard --size 12"), 2);
    EXPECT_EQ(run("evaluate --preset hard --decoder best"), 2);
    EXPECT_EQ(run("evaluate frames --frames 5"), 2);
}

}  // namespace
}  // namespace dotpose::test
