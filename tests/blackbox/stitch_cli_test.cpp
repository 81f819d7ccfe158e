// Tests `dotpose calibrate --stitch`, which computes the world poses in the sheet file from frames
// that show a seam between sheets.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <gmock/gmock.h>

#include "dotpose/files/sheet_file.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kSpacing_mm = kDefaultSpacing_mm;
constexpr int kSide_cells = 60;
/// Position of the second sheet's upper left corner in the coordinates of the first sheet, and the
/// clockwise rotation of the second sheet.
constexpr double kRight_mm = 31.5;
constexpr double kDown_mm = 0.7;
constexpr double kTurn_rad = 0.012;

SheetEntry sheet(const std::string& name, std::uint32_t origin_x) {
    SheetEntry entry;
    entry.name = name;
    entry.sheet.origin = {origin_x, 4096};
    entry.sheet.columns = entry.sheet.rows = kSide_cells;
    entry.sheet.width_mm = entry.sheet.height_mm = 31;
    entry.sheet.origin_x_mm = entry.sheet.origin_y_mm = 0.5;
    return entry;
}

/// Returns a frame of one sheet, centred on (x_mm, y_mm). This position is measured from the upper
/// left corner of the sheet.
GreyImage sheet_frame(const Shot& like, const SheetEntry& entry, double x_mm, double y_mm,
                      double theta_rad) {
    Shot shot = like;
    const double x = entry.sheet.origin.x + (x_mm - entry.sheet.origin_x_mm) / kSpacing_mm;
    const double y = entry.sheet.origin.y + (y_mm - entry.sheet.origin_y_mm) / kSpacing_mm;
    shot.page = page_of(entry.sheet);
    shot.pose.cell = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
    shot.pose.fraction_x = x - std::floor(x);
    shot.pose.fraction_y = y - std::floor(y);
    shot.pose.theta_rad = theta_rad;
    return render(shot);
}

/// Returns a frame centred on a position on the table, in the coordinates of the first sheet.
/// Renders each sheet alone with the same light and noise, and takes the darker value of each
/// pixel, so the frame shows the dots of both sheets.
GreyImage table_frame(std::uint64_t index, double x_mm, double y_mm, double theta_rad) {
    Setup setup;
    setup.camera.width_px = 376;
    setup.camera.height_px = 240;
    const Shot like = draw_shot(setup, index);
    GreyImage image = sheet_frame(like, sheet("left", 2048), x_mm, y_mm, theta_rad);
    const double c = std::cos(kTurn_rad);
    const double s = std::sin(kTurn_rad);
    const double dx = x_mm - kRight_mm;
    const double dy = y_mm - kDown_mm;
    const GreyImage right = sheet_frame(like, sheet("right", 6144), c * dx + s * dy,
                                        c * dy - s * dx, theta_rad - kTurn_rad);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = std::min(image.pixels[i], right.pixels[i]);
    return image;
}

using StitchCommand = ToolCommand;

TEST_F(StitchCommand, WritesWorldPosesIntoTheSheetFile) {
    {
        SheetFile file(directory_ / "sheets.json");
        SheetEntry left = sheet("left", 2048);
        left.world = WorldPose{2, 1, 0};
        file.add(left);
        file.add(sheet("right", 6144));
        file.save();
    }
    for (std::uint64_t i = 0; i < 12; ++i) {
        const double along_mm = 3 + 2.2 * static_cast<double>(i);
        write_pgm(directory_ / ("seam" + std::to_string(i) + ".pgm"),
                  table_frame(i, 31.2, along_mm, 0.5 * static_cast<double>(i)).view());
    }
    ASSERT_EQ(run("calibrate --stitch --sheets sheets.json seam*.pgm"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("frames      12 of 12 show two sheets"));
    EXPECT_THAT(output_, HasSubstr("sheet       left: stays where it is"));
    // Without a camera file, the size of a pixel in mm is unknown, and so are the print scales.
    EXPECT_THAT(output_, HasSubstr("(UNKNOWN) along x"));
    EXPECT_THAT(output_, HasSubstr("UNKNOWN:    these frames do not determine the scales"));
    const auto sheets = read_sheets(directory_ / "sheets.json");
    EXPECT_EQ(sheets[0].world->x_m, 2);
    EXPECT_NEAR(sheets[1].world->x_m, 2 + kRight_mm / 1000, 3e-5);
    EXPECT_NEAR(sheets[1].world->y_m, 1 - kDown_mm / 1000, 3e-5);
    EXPECT_NEAR(sheets[1].world->yaw_rad, -kTurn_rad, 0.02 * std::numbers::pi / 180);

    // Locates a frame on the right sheet. Its expected world position follows from the world pose
    // of the left sheet.
    write_pgm(directory_ / "right.pgm", table_frame(20, 45, 12, 0.3).view());
    ASSERT_EQ(run("locate --sheets sheets.json right.pgm"), 0) << errors_;
    const json record = json::parse(output_);
    EXPECT_EQ(record["sheet"], "right");
    EXPECT_NEAR(record["x_m"].get<double>(), 2.045, 3e-5);
    EXPECT_NEAR(record["y_m"].get<double>(), 1 - 0.012, 3e-5);
    EXPECT_NEAR(record["yaw_rad"].get<double>(), -0.3, 0.001);

    // If the camera file contains mm_per_px, the print scales can also be determined.
    std::ofstream(directory_ / "camera.yaml")
        << "{format: dotpose-camera, version: 1, width_px: 376, height_px: 240, k_per_px2: 0, "
           "centre_px: [187.5, 119.5], mm_per_px: [0.046, 0.046]}";
    const std::string stitch = "calibrate --stitch --sheets sheets.json --camera camera.yaml ";
    ASSERT_EQ(run(stitch + "--true-scale camera --draw sheets.svg seam*.pgm"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("scale       by the camera's mm per px"));
    EXPECT_THAT(output_, Not(HasSubstr("UNKNOWN")));
    EXPECT_THAT(file("sheets.svg"), HasSubstr("</svg>"));
    // The required accuracy of the scales is 0.1 mm in 200 mm.
    for (const SheetEntry& entry : read_sheets(directory_ / "sheets.json")) {
        EXPECT_NEAR(entry.print_scale_x, 1, 5e-4) << entry.name;
        EXPECT_NEAR(entry.print_scale_y, 1, 5e-4) << entry.name;
    }
    // The given width of the right sheet is 0.5 % larger than nominal, so the scales of all sheets
    // increase by 0.5 %.
    const double width_mm = 1.005 * (kSide_cells - 1) * kSpacing_mm;
    ASSERT_EQ(run(stitch + "--true-scale right=" + std::to_string(width_mm) + " seam*.pgm"), 0)
        << errors_;
    for (const SheetEntry& entry : read_sheets(directory_ / "sheets.json"))
        EXPECT_NEAR(entry.print_scale_x, 1.005, 1e-3) << entry.name;
    EXPECT_EQ(run(stitch + "--true-scale ruler seam*.pgm"), 2);
    EXPECT_EQ(run(stitch + "--true-scale none=30 seam*.pgm"), 2);
    EXPECT_THAT(errors_, HasSubstr("there is no sheet 'none'"));
    EXPECT_EQ(run("calibrate --true-scale camera seam*.pgm"), 2);

    EXPECT_EQ(run("calibrate --stitch --sheets sheets.json right.pgm"), 1);
    EXPECT_THAT(errors_, HasSubstr("none of the 1 frames shows two sheets"));
    EXPECT_EQ(run("calibrate --sheets sheets.json right.pgm"), 1);
}

}  // namespace
}  // namespace dotpose::test
