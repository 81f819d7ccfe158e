// Tests the stitching of four adjacent sheets with gaps and small rotations, using frames that show
// the seams between the sheets.
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "../../xml_check.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "frames.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate_test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Returns a frame taken in the middle of sheet a.
GreyImage plain_frame(const CameraModel& camera, int index) {
    return table_frame(kTable, camera, 62, index, 30, 30, 0.1 * index);
}

/// Returns a table whose sheets have different print scales along x and y. As in typical prints,
/// the scales are wrong by up to 0.3 %. The mean scale of the first sheet is 1.
Table printed_table() {
    Table table = kTable;
    table[0].print = {1.0012, 1 / 1.0012};
    table[1].print = {1.0031, 0.9987};
    table[2].print = {0.9974, 1.0009};
    table[3].print = {0.9995, 0.9970};
    return table;
}

double off_mm(const WorldPose& world, const Lying& lying) {
    return std::hypot(1000 * world.x_m - lying.x_mm, -1000 * world.y_m - lying.y_mm);
}

TEST(StitchSheets, FindsHowFourSheetsLieAndHowLongTheyWerePrinted) {
    const CameraModel model = wide_camera();
    const Table table = printed_table();
    const auto stitching =
        stitch_sheets(200, [&](int i) { return seam_frame(table, model, 61, i); },
                      sheets_of_table(), true_camera(model), {});
    EXPECT_GT(stitching.used, 150);
    EXPECT_THAT(stitching.unconnected, IsEmpty());
    ASSERT_EQ(stitching.stitched.size(), table.size());
    EXPECT_TRUE(stitching.stitched[0].is_fixed);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const SheetEntry& entry = stitching.sheets[i];
        const StitchedSheet& sheet = stitching.stitched[i];
        const double off_rad = std::abs(-entry.world->yaw_rad - table[i].turn_rad);
        EXPECT_LT(off_mm(*entry.world, table[i]), 0.02) << entry.name;
        EXPECT_LT(off_rad, 0.01 * kDegree_rad) << entry.name;
        EXPECT_NEAR(entry.print_scale_x, table[i].print.x, 5 * sheet.sigma_scale_x) << entry.name;
        EXPECT_NEAR(entry.print_scale_y, table[i].print.y, 5 * sheet.sigma_scale_y) << entry.name;
        EXPECT_LT(sheet.sigma_scale_x, 1e-4);
        EXPECT_LT(sheet.sigma_scale_y, 1e-4);
        if (i == 0) continue;
        EXPECT_LT(off_mm(*entry.world, table[i]), 5 * sheet.sigma_mm) << entry.name;
        EXPECT_LT(off_rad, 5 * sheet.sigma_rad) << entry.name;
    }
    for (const Seam& seam : stitching.seams)
        EXPECT_LT(seam.residual_mm, 0.02) << seam.first << seam.second;

    // World positions must be correct on different sheets, even far from the seams.
    Locator locator{DeviceOptions{}};
    Camera camera = true_camera(model);
    // The reference point is 20 mm to the right of the image centre, so that a wrong scale
    // causes a visible error.
    camera.reference_px =
        PixelPoint{(model.width_px - 1) / 2.0 + 20 / model.mm_per_px, (model.height_px - 1) / 2.0};
    for (const auto& [x_mm, y_mm] : {std::pair(20.0, 40.0), std::pair(90.0, 110.0)}) {
        constexpr double kTheta_rad = 0.4;
        const GreyImage image = table_frame(table, model, 61, 300, x_mm, y_mm, kTheta_rad);
        DeviceOptions options;
        use_camera(camera, image.width_px, image.height_px, options);
        locator.set_options(options);
        const Fix fix = locator.locate(image.view());
        const auto seen = find_sheet(stitching.sheets, CodeVariant::anoto, fix);
        ASSERT_TRUE(seen);
        const auto place =
            find_sheet(stitching.sheets, CodeVariant::anoto,
                       with_camera(fix, camera, locator.trace(), seen->entry->print_scale()));
        const WorldPlace found = world_place(place.value()).value();
        EXPECT_NEAR(1000 * found.x_m, x_mm + 20 * std::cos(kTheta_rad), 0.02);
        EXPECT_NEAR(-1000 * found.y_m, y_mm + 20 * std::sin(kTheta_rad), 0.02);
        EXPECT_NEAR(-found.yaw_rad, kTheta_rad, 0.03 * kDegree_rad);
    }
}

// A fix computed from the whole image belongs to only one of the two sheets, but `stitch_sheets`
// must also find the other sheet.
TEST(StitchSheets, FindsBothSheetsOfAPhotoWithWideMargins) {
    CameraModel model = wide_camera();
    model.width_px = 1000;
    model.height_px = 750;
    model.k = 0;
    Table table = kTable;
    table[1].x_mm += 8;
    const auto photo = [&](int i) {
        return table_frame(table, model, 66, i, kPage_mm + 7, 25 + 2.0 * i, 0.05 * i);
    };
    const auto stitching = stitch_sheets(4, photo, sheets_of_table(), true_camera(model), {});
    EXPECT_EQ(stitching.used, 4);
    EXPECT_LT(off_mm(stitching.sheets[1].world.value(), table[1]), 0.05);
}

/// Returns frames along the upper seam, which show sheets a and b.
FrameAt upper_seam(const Table& table, const CameraModel& model) {
    return [&](int i) {
        return table_frame(table, model, 65, i, kPage_mm + 0.5, 8 + 2.0 * i, 0.7 * i);
    };
}

TEST(StitchSheets, OnlyAReferenceMakesPrintScalesTrue) {
    const CameraModel model = wide_camera();
    Table table = kTable;
    table[0].print = {1.004, 1.002};
    table[1].print = {1.001, 1.003};
    const auto frame_at = upper_seam(table, model);
    const auto expect_scale = [](const Stitching& stitching, std::size_t i, double x, double y) {
        const StitchedSheet& sheet = stitching.stitched[i];
        EXPECT_NEAR(stitching.sheets[i].print_scale_x, x, 5 * sheet.sigma_scale_x) << i;
        EXPECT_NEAR(stitching.sheets[i].print_scale_y, y, 5 * sheet.sigma_scale_y) << i;
    };
    // The mean scale of the first sheet in the file remains 1. All scales are relative to this
    // sheet.
    const auto relative = stitch_sheets(25, frame_at, sheets_of_table(), true_camera(model), {});
    expect_scale(relative, 0, 1.001, 0.999);
    expect_scale(relative, 1, 1.001 / 1.003, 1.003 / 1.003);
    const auto by_camera = stitch_sheets(25, frame_at, sheets_of_table(), true_camera(model), {},
                                         {ScaleReference::By::camera, "", 0});
    expect_scale(by_camera, 0, 1.004, 1.002);
    expect_scale(by_camera, 1, 1.001, 1.003);
    Camera wrong = true_camera(model);
    wrong.paper->mm_per_px_x *= 1.5;
    wrong.paper->mm_per_px_y *= 1.5;
    EXPECT_THROW(stitch_sheets(25, frame_at, sheets_of_table(), wrong, {},
                               {ScaleReference::By::camera, "", 0}),
                 Error);
    const double width_mm = 1.001 * (kSide_cells - 1) * kDefaultSpacing_mm;
    const auto by_width = stitch_sheets(25, frame_at, sheets_of_table(), true_camera(model), {},
                                        {ScaleReference::By::width, "b", width_mm});
    expect_scale(by_width, 0, 1.004, 1.002);
    EXPECT_NEAR(by_width.sheets[1].print_scale_x, 1.001, 1e-6);
    EXPECT_LT(off_mm(*by_width.sheets[1].world, table[1]), 0.02);
}

// Repeated frames show the same dots with the same printing errors, so they add no information.
TEST(StitchSheets, FramesThatRepeatDotsDoNotMakeItMoreCertain) {
    const CameraModel model = wide_camera();
    const FrameAt seam = upper_seam(kTable, model);
    const auto stitched = [&](int frames) {
        return stitch_sheets(frames, [&](int i) { return seam(i % 12); }, sheets_of_table(),
                             true_camera(model), {})
            .stitched.at(1);
    };
    const StitchedSheet once = stitched(12);
    const StitchedSheet twice = stitched(24);
    EXPECT_NEAR(twice.sigma_mm / once.sigma_mm, 1, 0.05);
    EXPECT_NEAR(twice.sigma_rad / once.sigma_rad, 1, 0.05);
    EXPECT_NEAR(twice.sigma_scale_x / once.sigma_scale_x, 1, 0.05);
    EXPECT_NEAR(twice.sigma_scale_y / once.sigma_scale_y, 1, 0.05);
}

TEST(DrawStitching, ShowsSheetsBeforeAndAfter) {
    const CameraModel model = wide_camera();
    std::vector<SheetEntry> before = sheets_of_table();
    before[0].world = WorldPose{0, 0, 0};
    const auto stitching =
        stitch_sheets(6, upper_seam(kTable, model), before, true_camera(model), {});
    ASSERT_EQ(stitching.measurements.size(), 6U);
    const test::TemporaryDirectory directory;
    const auto path = directory.path() / "stitching.svg";
    const auto picture = [&] {
        draw_stitching(path, before, stitching);
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        EXPECT_EQ(test::XmlCheck(text.str()).problem(), "");
        return text.str();
    };
    EXPECT_THAT(picture(), HasSubstr("not all of these sheets had a world pose"));
    // Before stitching, sheet b is 1 mm to the right of its true position. The error is 1 mm along
    // x and 0 along y, which is 0.71 mm rms per axis.
    before[1].world =
        WorldPose{(kTable[1].x_mm + 1) / 1000, -kTable[1].y_mm / 1000, -kTable[1].turn_rad};
    EXPECT_THAT(picture(), testing::AllOf(HasSubstr(">Before<"), HasSubstr(">After<"),
                                          testing::ContainsRegex("0\\.7[01][0-9][0-9] mm rms")));
    EXPECT_THROW(draw_stitching("/no/such/folder/a.svg", before, stitching), Error);
}

TEST(StitchSheets, SaysWhichScalesTheFramesDoNotTell) {
    const CameraModel model = wide_camera();
    Camera camera = true_camera(model);
    camera.paper.reset();  // hand-held, at an unknown height
    auto entries = sheets_of_table();
    entries[1].print_scale_x = 1.002;
    const auto stitching = stitch_sheets(12, upper_seam(kTable, model), entries, camera, {});
    ASSERT_EQ(stitching.stitched.size(), 2U);
    // The frames do not determine the ratio of the first sheet's x scale to its y scale, so the
    // scales of all sheets are unknown.
    for (const StitchedSheet& sheet : stitching.stitched) {
        EXPECT_FALSE(is_scale_known(sheet.sigma_scale_x)) << sheet.name;
        EXPECT_FALSE(is_scale_known(sheet.sigma_scale_y)) << sheet.name;
    }
    EXPECT_NEAR(stitching.sheets[0].print_scale_x, 1, 1e-5);
    EXPECT_NEAR(stitching.sheets[0].print_scale_y, 1, 1e-5);
    // The frames determine the scale of the second sheet, relative to that of the first, more
    // accurately along the seam than across it.
    EXPECT_NEAR(stitching.sheets[1].print_scale_y, 1, 5e-4);
    EXPECT_NEAR(stitching.sheets[1].print_scale_x, 1, 2e-3);
    EXPECT_LT(off_mm(*stitching.sheets[1].world, kTable[1]), 0.05);
}

TEST(StitchSheets, RefusesReferencesThatTellNothing) {
    const CameraModel model = wide_camera();
    const auto frame_at = upper_seam(kTable, model);
    const auto stitch = [&](const std::optional<Camera>& camera, const ScaleReference& reference) {
        stitch_sheets(3, frame_at, sheets_of_table(), camera, {}, reference);
    };
    using By = ScaleReference::By;
    EXPECT_THROW(stitch(std::nullopt, {By::camera, "", 0}), BadArgument);
    EXPECT_THROW(stitch(true_camera(model), {By::width, "none", 60}), BadArgument);
    EXPECT_THROW(stitch(true_camera(model), {By::width, "a", 0}), BadArgument);
    EXPECT_THROW(stitch(true_camera(model), {By::width, "c", 60}), Error);  // not in any frame
}

TEST(StitchSheets, KeepsTheSheetThatLiesInTheWorldAndNamesThoseNotSeen) {
    const CameraModel model = wide_camera();
    std::vector<SheetEntry> entries = sheets_of_table();
    entries[1].world = WorldPose{1.25, -0.5, 0.3};
    // The frames show only the upper seam, with sheets a and b.
    const auto frame_at = [&](int i) {
        return table_frame(kTable, model, 64, i, kPage_mm + 0.5, 10 + 2.0 * i, 0.7 * i);
    };
    const auto stitching = stitch_sheets(20, frame_at, entries, true_camera(model), {});
    EXPECT_THAT(stitching.unconnected, ElementsAre("c", "d"));
    EXPECT_TRUE(stitching.stitched[1].is_fixed);
    const WorldPose& b = stitching.sheets[1].world.value();
    EXPECT_EQ(b.x_m, 1.25);
    EXPECT_EQ(b.y_m, -0.5);
    EXPECT_EQ(b.yaw_rad, 0.3);
    // Expected pose of sheet a. The vector from the corner of b to the corner of a is first rotated
    // from the table axes into the axes of b, and then by the yaw of b in the world.
    const WorldPose& a = stitching.sheets[0].world.value();
    const double yaw = 0.3 + kTable[1].turn_rad;
    EXPECT_NEAR(a.yaw_rad, yaw, 0.02 * kDegree_rad);
    const double right_m = -kTable[1].x_mm / 1000;
    const double up_m = kTable[1].y_mm / 1000;
    EXPECT_NEAR(a.x_m, 1.25 + std::cos(yaw) * right_m - std::sin(yaw) * up_m, 3e-5);
    EXPECT_NEAR(a.y_m, -0.5 + std::sin(yaw) * right_m + std::cos(yaw) * up_m, 3e-5);
    EXPECT_FALSE(stitching.sheets[2].world.has_value());
}

// Regression: `stitch_sheets` crashed if no frame contained the first sheet that has a world pose.
TEST(StitchSheets, FramesMustShowASheetThatLiesInTheWorld) {
    const CameraModel model = wide_camera();
    const auto c_beside_d = [&](int i) {
        return table_frame(kTable, model, 65, i, kPage_mm + 1.2, kPage_mm + 12 + 4.0 * i, 0.7 * i);
    };
    std::vector<SheetEntry> entries = sheets_of_table();
    entries[0].world = WorldPose{1.25, -0.5, 0.3};
    try {
        stitch_sheets(1, c_beside_d, entries, true_camera(model), {});
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("no frame shows 'a', which has a world pose"));
    }
    entries[3].world = WorldPose{1, 2, 0};
    const auto stitching = stitch_sheets(6, c_beside_d, entries, true_camera(model), {});
    EXPECT_THAT(stitching.unconnected, ElementsAre("a", "b"));
    EXPECT_EQ(stitching.sheets[3].world->x_m, 1);
    EXPECT_NEAR(stitching.sheets[2].world->yaw_rad, kTable[3].turn_rad - kTable[2].turn_rad,
                0.02 * kDegree_rad);
}

TEST(StitchSheets, RefusesFramesWithoutASeam) {
    const CameraModel model = wide_camera();
    const auto plain = [&](int i) { return plain_frame(model, i); };
    try {
        stitch_sheets(3, plain, sheets_of_table(), std::nullopt, {});
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("none of the 3 frames shows two sheets"));
    }
    EXPECT_THROW(stitch_sheets(3, plain, {sheets_of_table().front()}, std::nullopt, {}), Error);
}

}  // namespace
}  // namespace dotpose
