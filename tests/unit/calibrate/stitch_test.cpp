// Four sheets that lie beside each other with gaps and small turns, and a camera over their seams.
#include <array>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/calibrate.hpp"
#include "dotpose/locate.hpp"
#include "frames.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate_test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Sheets of 120 x 120 dots; the pattern reaches to the edge but for this.
constexpr int kSide_cells = 120;
constexpr double kMargin_mm = 0.3;
constexpr double kPage_mm = (kSide_cells - 1) * kDefaultSpacing_mm + 2 * kMargin_mm;

/// On the table: mm, x right, y down, angles clockwise.
struct Lying {
    double x_mm;
    double y_mm;
    double turn_rad;
};

/// Gaps of 0 to 3 mm, turns of up to 1 degree.
const std::array<Lying, 4> kLying = {Lying{0, 0, 0}, Lying{kPage_mm + 0.2, 0.4, 0.6 * kDegree_rad},
                                     Lying{-0.3, kPage_mm + 1.4, -0.3 * kDegree_rad},
                                     Lying{kPage_mm + 2.6, kPage_mm + 1.9, -1.0 * kDegree_rad}};

std::vector<SheetEntry> sheets() {
    std::vector<SheetEntry> entries;
    for (std::uint32_t i = 0; i < kLying.size(); ++i) {
        SheetEntry entry;
        entry.name = std::string(1, static_cast<char>('a' + i));
        entry.sheet.origin = {4096 + 2048 * i, 8192};
        entry.sheet.columns = entry.sheet.rows = kSide_cells;
        entry.sheet.width_mm = entry.sheet.height_mm = kPage_mm;
        entry.sheet.origin_x_mm = entry.sheet.origin_y_mm = kMargin_mm;
        entries.push_back(entry);
    }
    return entries;
}

CameraModel wide_camera() {
    CameraModel camera;
    camera.width_px = 376;
    camera.height_px = 240;
    camera.k = -2.2e-6;
    return camera;
}

/// What the camera sees at a place of the table; dots of all sheets are dark on one paper.
GreyImage table_frame(const CameraModel& camera, std::uint64_t seed, int index, double x_mm,
                      double y_mm, double theta_rad) {
    Setup setup;
    setup.camera = camera;
    setup.seed = seed;
    GreyImage result;
    const std::vector<SheetEntry> entries = sheets();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Lying& lying = kLying[i];
        const double dx = x_mm - lying.x_mm;
        const double dy = y_mm - lying.y_mm;
        const double c = std::cos(lying.turn_rad);
        const double s = std::sin(lying.turn_rad);
        const double middle_x_mm = lying.x_mm + kPage_mm / 2;
        const double middle_y_mm = lying.y_mm + kPage_mm / 2;
        constexpr double kTooFar_mm = kPage_mm / 2 + 12;  // for any dot to be in view
        if (std::abs(x_mm - middle_x_mm) > kTooFar_mm) continue;
        if (std::abs(y_mm - middle_y_mm) > kTooFar_mm) continue;
        const Sheet& sheet = entries[i].sheet;
        Shot shot = moved_to(draw_shot(setup, static_cast<std::uint64_t>(index)),
                             c * dx + s * dy - kMargin_mm + sheet.origin.x * kDefaultSpacing_mm,
                             c * dy - s * dx - kMargin_mm + sheet.origin.y * kDefaultSpacing_mm,
                             theta_rad - lying.turn_rad);
        shot.page = page_of(sheet, i + 1);
        const GreyImage image = render(shot);
        // Light and noise are the same each time.
        if (result.pixels.empty()) result = image;
        for (std::size_t k = 0; k < image.pixels.size(); ++k)
            result.pixels[k] = std::min(result.pixels[k], image.pixels[k]);
    }
    return result;
}

/// A drive along the seams, with the camera at any angle.
GreyImage seam_frame(const CameraModel& camera, int index) {
    Rng rng(61, static_cast<std::uint64_t>(index));
    const double along_mm = rng.uniform(5, 2 * kPage_mm - 5);
    const double across_mm = kPage_mm + rng.uniform(-1.5, 2.5);
    const double theta_rad = rng.uniform(-180, 180) * kDegree_rad;
    return index % 2 == 0 ? table_frame(camera, 61, index, along_mm, across_mm, theta_rad)
                          : table_frame(camera, 61, index, across_mm, along_mm, theta_rad);
}

/// A frame that looks at the middle of one sheet.
GreyImage plain_frame(const CameraModel& camera, int index) {
    return table_frame(camera, 62, index, 30, 30, 0.1 * index);
}

TEST(StitchSheets, FindsHowFourSheetsLie) {
    const CameraModel model = wide_camera();
    const auto stitching = stitch_sheets(200, [&](int i) { return seam_frame(model, i); }, sheets(),
                                         true_camera(model), {});
    EXPECT_GT(stitching.used, 150);
    EXPECT_THAT(stitching.unconnected, IsEmpty());
    ASSERT_EQ(stitching.stitched.size(), kLying.size());
    EXPECT_TRUE(stitching.stitched[0].is_fixed);
    for (std::size_t i = 0; i < kLying.size(); ++i) {
        const WorldPose& world = stitching.sheets[i].world.value();
        const double off_mm =
            std::hypot(1000 * world.x_m - kLying[i].x_mm, -1000 * world.y_m - kLying[i].y_mm);
        const double off_rad = std::abs(-world.yaw_rad - kLying[i].turn_rad);
        EXPECT_LT(off_mm, 0.02) << stitching.sheets[i].name;
        EXPECT_LT(off_rad, 0.01 * kDegree_rad) << stitching.sheets[i].name;
        if (i == 0) continue;
        EXPECT_LT(off_mm, 5 * stitching.stitched[i].sigma_mm) << stitching.sheets[i].name;
        EXPECT_LT(off_rad, 5 * stitching.stitched[i].sigma_rad) << stitching.sheets[i].name;
    }
    for (const Seam& seam : stitching.seams)
        EXPECT_LT(seam.residual_mm, 0.02) << seam.first << seam.second;

    // One world: where two sheets meet, both sides tell the same place.
    const auto workspace = std::make_unique<LargeWorkspace>();
    const Camera camera = true_camera(model);
    for (const auto& [x_mm, y_mm] : {std::pair(30.0, 40.0), std::pair(100.0, 90.0)}) {
        const GreyImage image = table_frame(model, 63, 0, x_mm, y_mm, 0.4);
        Options options;
        use_camera(camera, image.width_px, image.height_px, options);
        const Fix fix =
            with_camera(locate(image.view(), options, *workspace), camera, options, *workspace);
        const auto place = find_sheet(stitching.sheets, Profile::anoto, fix);
        ASSERT_TRUE(place);
        const WorldPose found = world_pose(*place).value();
        EXPECT_NEAR(1000 * found.x_m, x_mm, 0.03);
        EXPECT_NEAR(-1000 * found.y_m, y_mm, 0.03);
        EXPECT_NEAR(-found.yaw_rad, 0.4, 0.02 * kDegree_rad);
    }
}

TEST(StitchSheets, KeepsTheSheetThatLiesInTheWorldAndNamesThoseNotSeen) {
    const CameraModel model = wide_camera();
    std::vector<SheetEntry> entries = sheets();
    entries[1].world = WorldPose{1.25, -0.5, 0.3};
    // Over the upper seam only: sheets a and b.
    const auto frame_at = [&](int i) {
        return table_frame(model, 64, i, kPage_mm + 0.5, 10 + 2.0 * i, 0.7 * i);
    };
    const auto stitching = stitch_sheets(20, frame_at, entries, true_camera(model), {});
    EXPECT_THAT(stitching.unconnected, ElementsAre("c", "d"));
    EXPECT_TRUE(stitching.stitched[1].is_fixed);
    const WorldPose& b = stitching.sheets[1].world.value();
    EXPECT_EQ(b.x_m, 1.25);
    EXPECT_EQ(b.y_m, -0.5);
    EXPECT_EQ(b.yaw_rad, 0.3);
    // Sheet a against b: back from b's corner by b's turn, then into the world by b's yaw.
    const WorldPose& a = stitching.sheets[0].world.value();
    const double yaw = 0.3 + kLying[1].turn_rad;
    EXPECT_NEAR(a.yaw_rad, yaw, 0.02 * kDegree_rad);
    const double right_m = -kLying[1].x_mm / 1000;
    const double up_m = kLying[1].y_mm / 1000;
    EXPECT_NEAR(a.x_m, 1.25 + std::cos(yaw) * right_m - std::sin(yaw) * up_m, 3e-5);
    EXPECT_NEAR(a.y_m, -0.5 + std::sin(yaw) * right_m + std::cos(yaw) * up_m, 3e-5);
    EXPECT_FALSE(stitching.sheets[2].world.has_value());
}

TEST(StitchSheets, RefusesFramesWithoutASeam) {
    const CameraModel model = wide_camera();
    const auto plain = [&](int i) { return plain_frame(model, i); };
    try {
        stitch_sheets(3, plain, sheets(), std::nullopt, {});
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("none of the 3 frames shows two sheets"));
    }
    EXPECT_THROW(stitch_sheets(3, plain, {sheets().front()}, std::nullopt, {}), Error);
}

}  // namespace
}  // namespace dotpose
