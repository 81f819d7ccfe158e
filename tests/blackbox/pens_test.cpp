// Tests the commands for pens: `calibrate --pivot`, the pen tip in the output lines of `locate` and
// `watch`, and `ink`.
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../inkml_check.hpp"
#include "../json_schema.hpp"
#include "../pen_frames.hpp"
#include "../xml_check.hpp"
#include "dotpose/files/camera_file.hpp"
#include "dotpose/tools/image_file.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kMaxTilt_rad = 40 * std::numbers::pi / 180;

class Pens : public ToolCommand {
  protected:
    void put_camera(const std::string& name, bool has_tip) const {
        Camera camera = pen_camera();
        camera.gain = 2;
        if (has_tip) camera.tip = kTip;
        write_camera(directory_ / name, camera);
    }
    void put_frame(const std::string& name, std::uint64_t index, const PenPose& pose) const {
        write_pgm(directory_ / name, render(shot_of_pen(pen_shot(31, index), kTip, pose)).view());
    }
    void put_text(const std::string& name, const std::string& text) const {
        std::ofstream(directory_ / name) << text;
    }
};

TEST_F(Pens, CalibrateWritesTheTip) {
    put_camera("camera.yaml", false);
    Rng rng(4);
    for (std::uint64_t i = 0; i < 12; ++i)
        put_frame(fmt::format("pen-{:02}.pgm", i), i, pivoted(500, 700, kMaxTilt_rad, rng));
    ASSERT_EQ(run("calibrate --spacing 0.3 --camera camera.yaml -o pen.yaml --pivot pen-*.pgm"), 0)
        << errors_;
    EXPECT_THAT(output_, HasSubstr("12 of 12 frames located"));
    EXPECT_THAT(output_, ContainsRegex("tip +x [0-9.]+ \\+- [0-9.]+, y "));
    const Camera camera = read_camera(directory_ / "pen.yaml");
    ASSERT_TRUE(camera.tip);
    EXPECT_NEAR(camera.tip->x_mm, kTip.x_mm, 0.02);
    EXPECT_NEAR(camera.tip->y_mm, kTip.y_mm, 0.02);
    EXPECT_NEAR(camera.tip->z_mm, kTip.z_mm, 0.03);
    EXPECT_NEAR(camera.tip->rest_mm, kTip.rest_mm, 0.03);
    EXPECT_GT(camera.sigma.at("tip_z_mm"), 0);
    EXPECT_EQ(camera.gain, 2);
    EXPECT_EQ(run("calibrate --pivot pen-*.pgm"), 2);
    EXPECT_THAT(errors_, HasSubstr("--pivot needs --camera FILE"));
}

TEST_F(Pens, LinesHaveTheTip) {
    put_camera("pen.yaml", true);
    put_camera("camera.yaml", false);
    PenPose pose;
    pose.x_mm = 500;
    pose.y_mm = 700;
    pose.tilt_rad = 0.5;
    put_frame("0.pgm", 0, pose);
    pose.height_mm = 0.5;
    put_frame("1.pgm", 1, pose);
    const std::string how = "--spacing 0.3 --camera pen.yaml --pose space ";
    ASSERT_EQ(run("locate " + how + "0.pgm 1.pgm"), 0) << errors_;
    const auto lines = lines_of(output_);
    const json down = json::parse(lines.at(0));
    EXPECT_NEAR(down["tip_x_mm"], 500, 0.03);
    EXPECT_NEAR(down["tip_y_mm"], 700, 0.03);
    EXPECT_NEAR(down["tip_height_mm"], 0, 0.03);
    EXPECT_LT(down["sigma_tip_height_mm"], 0.02);
    EXPECT_EQ(down["pen_down"], true);
    const JsonSchema schema{
        json::parse(read_file(fs::path(source_dir()) / "docs/schema/lines-1.json"))};
    const JsonSchema::Verdict verdict = schema.check(down);
    EXPECT_THAT(verdict.errors, IsEmpty());
    for (const auto& [key, value] : down.items())
        EXPECT_THAT(verdict.described_keys, Contains(key));
    const json up = json::parse(lines.at(1));
    EXPECT_NEAR(up["tip_height_mm"], 0.5, 0.03);
    EXPECT_EQ(up["pen_down"], false);
    ASSERT_EQ(run("locate --units ros " + how + "1.pgm"), 0);
    const json ros = json::parse(output_);
    EXPECT_NEAR(ros["tip_y_pattern_m"], -0.7, 3e-5);
    EXPECT_NEAR(ros["tip_height_m"], 0.0005, 3e-5);
    ASSERT_EQ(run("locate --format text " + how + "1.pgm"), 0);
    EXPECT_THAT(output_, ContainsRegex("tip x 50[0-9.]+ ± [0-9.]+ mm, .*, pen up"));
    ASSERT_EQ(run("locate --spacing 0.3 --camera camera.yaml --pose space 0.pgm"), 0);
    EXPECT_THAT(output_, Not(HasSubstr("tip_")));
}

TEST_F(Pens, InkIsDrawnFromLogsAndLines) {
    put_camera("pen.yaml", true);
    PenPose pose;
    pose.tilt_rad = 0.5;
    pose.y_mm = 700;
    for (std::uint64_t i = 0; i < 8; ++i) {
        pose.x_mm = 500 + 0.2 * double(i);
        put_frame(fmt::format("{}.pgm", i), i, pose);
    }
    const std::string how = "--spacing 0.3 --camera pen.yaml --pose space ";
    ASSERT_EQ(run("watch " + how + "--fps 200 --no-window --log run.csv -o lines.json *.pgm"), 0)
        << errors_;
    ASSERT_EQ(run("ink run.csv -o a.svg"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("a.svg: 1 strokes, 1.4 mm"));
    EXPECT_EQ(XmlCheck(file("a.svg")).problem(), "");
    ASSERT_EQ(run("ink lines.json -o b.svg"), 0) << errors_;
    EXPECT_EQ(file("a.svg"), file("b.svg"));
    ASSERT_EQ(run("ink run.csv -o c.inkml"), 0) << errors_;
    EXPECT_EQ(XmlCheck(file("c.inkml")).problem(), "");
    EXPECT_EQ(InkMlCheck(file("c.inkml")).problem(), "");
    ASSERT_EQ(run("locate " + how + "*.pgm -o locate.json"), 0) << errors_;
    EXPECT_EQ(run("ink locate.json -o d.svg"), 1);
    EXPECT_THAT(errors_, HasSubstr("--fps"));
    EXPECT_EQ(run("ink locate.json --fps 200 -o d.svg"), 0) << errors_;
}

/// CSV header with the columns that `ink` reads. The `sheet` column contains the name of the page.
constexpr const char* kInkHeader =
    "t_s,sheet,tip_x_sheet_mm,tip_y_sheet_mm,tip_height_mm,sigma_tip_x_mm,sigma_tip_y_mm,"
    "sigma_tip_height_mm\n";

TEST_F(Pens, InkOfSeveralPagesHasAFilePerPage) {
    put_text("run.csv", std::string(kInkHeader) +
                            "0.00,one,10,20,0,0.01,0.01,0.01\n0.01,one,11,20,0,0.01,0.01,0.01\n"
                            "0.02,,,,,,,\n0.03,two/3,30,40,0,0.01,0.01,0.01\n");
    ASSERT_EQ(run("ink run.csv -o page.svg"), 0) << errors_;
    EXPECT_EQ(output_, "page-one.svg: 1 strokes, 1.0 mm\npage-two_3.svg: 1 strokes, 0.0 mm\n");
    EXPECT_FALSE(fs::exists(directory_ / "page.svg"));
    EXPECT_EQ(XmlCheck(file("page-two_3.svg")).problem(), "");
}

TEST_F(Pens, InkHasTheSizeOfTheSheet) {
    ASSERT_EQ(run("print --paper A5 --name note --sheets sheets.json -o note.svg"), 0) << errors_;
    put_text("run.csv", std::string(kInkHeader) + "0,note,10,20,0,0.01,0.01,0.01\n");
    ASSERT_EQ(run("ink run.csv --sheets sheets.json -o page.svg"), 0) << errors_;
    EXPECT_THAT(file("page.svg"), HasSubstr(R"(width="148mm" height="210mm")"));
    put_text("run.csv", std::string(kInkHeader) + "0,other,10,20,0,0.01,0.01,0.01\n");
    EXPECT_EQ(run("ink run.csv --sheets sheets.json -o page.svg"), 1);
    EXPECT_THAT(errors_, HasSubstr("has no sheet 'other'"));
}

TEST_F(Pens, InkRefusesOtherLogs) {
    put_text("run.csv", std::string(kInkHeader) + "0,,,,,,,\n");
    EXPECT_EQ(run("ink run.csv -o page.svg"), 1);
    EXPECT_THAT(errors_, HasSubstr("dotpose calibrate --pivot"));
    put_text("up.csv", std::string(kInkHeader) + "0,one,10,20,2,0.01,0.01,0.01\n");
    EXPECT_EQ(run("ink up.csv -o page.svg"), 1);
    EXPECT_THAT(errors_, HasSubstr("did not touch the paper"));
    put_text("back.csv", std::string(kInkHeader) +
                             "1,one,10,20,0,0.01,0.01,0.01\n"
                             "0,one,10,20,0,0.01,0.01,0.01\n");
    EXPECT_EQ(run("ink back.csv -o page.svg"), 1);
    EXPECT_THAT(errors_, HasSubstr("back.csv:3"));
    EXPECT_EQ(run("ink run.csv -o page.pdf"), 2);
    EXPECT_THAT(errors_, HasSubstr(".svg or .inkml"));
}

}  // namespace
}  // namespace dotpose::test
