// Tests what typical users do on their first afternoon with dotpose, as described in docs/start.md.
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../jpeg.hpp"
#include "sheets_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Shot phone_shot(const json& sheet) {
    Setup setup;
    setup.seed = 3;
    setup.random_section = false;
    setup.camera.width_px = 1600;
    setup.camera.height_px = 1200;
    setup.camera.mm_per_px = kDefaultSpacing_mm / 20;
    setup.camera.working_distance_mm = 80;
    Shot photo = draw_shot(setup, 0);
    photo.page.origin = {sheet["origin_x"], sheet["origin_y"]};
    photo.page.columns = sheet["columns"];
    photo.page.rows = sheet["rows"];
    photo.pose.cell = {photo.page.origin.x + 120, photo.page.origin.y + 150};
    return photo;
}

class Afternoon : public SheetsCommand {
  protected:
    void expect_ok(const std::string& arguments) {
        ASSERT_EQ(ToolCommand::run(arguments), 0) << arguments << "\n" << errors_;
    }

    /// Writes frames taken by a robot that drives along the x axis of the sheet, 1 mm per frame.
    void drive_over(const json& sheet, int frames) {
        fs::create_directory(directory_ / "drive");
        for (int i = 0; i < frames; ++i) {
            const auto seed = static_cast<std::uint64_t>(i);
            write_pgm(directory_ / "drive" / ("f" + std::to_string(100 + i) + ".pgm"),
                      frame_of(sheet, 30.0 + i, 25, 0, seed).view());
        }
    }
};

// A roboticist prints a sheet, enters the world pose of the sheet, tracks the robot, and replays
// the run.
TEST_F(Afternoon, OfARoboticist) {
    expect_ok("print -o table.pdf --paper 90x60 --sheets sheets.json --name table");
    expect_ok("sheets place table --x 1000 --y 2000 --yaw 90");
    drive_over(sheets().at(0), 20);
    expect_ok("watch drive --fps 50 --sheets sheets.json --units ros --log run.csv --draw run.svg");
    const auto lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 20U);
    const json last = json::parse(lines.back());
    EXPECT_EQ(last["sheet"], "table");
    // The last frame is 49 mm from the left and 25 mm from the upper edge of the page. The page has
    // a yaw of 90 degrees and its y axis points down, so its x axis is the world's y axis, and its
    // y axis is the world's x axis.
    EXPECT_NEAR(last["x_m"], 1.000 + 0.025, 2e-5);
    EXPECT_NEAR(last["y_m"], 2.000 + 0.049, 2e-5);
    EXPECT_NEAR(last["yaw_rad"], std::numbers::pi / 2, 0.005);
    EXPECT_NEAR(last["vy_m_s"], 0.05, 0.002);
    EXPECT_EQ(last["covariance_m_rad"].size(), 9U);
    expect_ok("replay run.csv --draw figures.svg");
    EXPECT_THAT(output_, HasSubstr("20"));
    EXPECT_THAT(read_file(directory_ / "figures.svg"), HasSubstr("</svg>"));
    expect_ok("sheets map -o map.svg");
    EXPECT_THAT(read_file(directory_ / "map.svg"), HasSubstr("table"));
    expect_ok("simulate -o lens --frames 12 --seed 5 --k -8.7e-6");
    expect_ok("calibrate lens -o camera.yaml");
    EXPECT_THAT(output_, HasSubstr("verdict"));
    expect_ok("watch drive --fps 50 --sheets sheets.json --camera camera.yaml");
}

// A teacher prints a page, takes a photo of it with a phone, measures the page with a ruler, and
// prints it again.
TEST_F(Afternoon, OfATeacherWithAPhone) {
    expect_ok("print -o sheet.pdf --paper A5 --sheets sheets.json --name table");
    const json sheet = sheets().at(0);
    const Shot photo = phone_shot(sheet);
    std::ofstream(directory_ / "photo.jpg") << jpeg_of(render(photo), 85);
    expect_ok("locate photo.jpg --sheets sheets.json --draw pictures");
    const json record = records().at(0);
    ASSERT_EQ(record["status"], "ok") << record;
    EXPECT_EQ(record["sheet"], "table");
    EXPECT_NEAR(
        record["x_sheet_mm"],
        sheet["first_x_mm"].get<double>() + (120 + photo.pose.fraction_x) * kDefaultSpacing_mm,
        0.05);
    EXPECT_TRUE(fs::exists(directory_ / "pictures" / "photo.svg"));
    expect_ok("sheets reprint table -o again.pdf");
    EXPECT_EQ(read_file(directory_ / "again.pdf"), read_file(directory_ / "sheet.pdf"));
}

// A device maker checks the optics of a device, and reads the packets that the device sends.
TEST_F(Afternoon, OfAMakerOfDevices) {
    expect_ok("optics --device paper");
    for (int i = 0; i < 3; ++i) {
        write_pgm(directory_ / ("f" + std::to_string(i) + ".pgm"),
                  render(shot(static_cast<std::uint64_t>(i))).view());
    }
    ASSERT_EQ(shell("\"$(dirname \"$T\")\"/dotpose_device_packets f?.pgm > packets.bin"), 0);
    expect_ok("listen packets.bin --format csv -o poses.csv");
    const auto lines = lines_of(read_file(directory_ / "poses.csv"));
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_THAT(lines[0], StartsWith("schema,"));
    EXPECT_THAT(lines[3], HasSubstr(",ok,"));
}

}  // namespace
}  // namespace dotpose::test
