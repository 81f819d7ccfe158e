// Tests device locators that locate small frames on known sheets.
#include "device/on_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::core_test::on_sheets_test {
namespace {

/// The region of an A4 page.
constexpr KnownRegion kSheet{CodeVariant::anoto, {}, {1024, 2048}, 393, 564};

Shot shot_on(const KnownRegion& sheet, int side_px, double spacing_px, std::uint64_t index) {
    Setup setup;
    setup.preset = Preset::nominal;
    setup.seed = 4220;
    setup.camera.width_px = setup.camera.height_px = side_px;
    setup.camera.mm_per_px = setup.pattern.spacing_mm / spacing_px;
    Shot shot = draw_shot(setup, index);
    Rng rng(shot.seed, 1);
    shot.page.pattern.section = sheet.section;
    shot.pose.cell = {sheet.first.x + 10 + rng.below(sheet.columns - 20),
                      sheet.first.y + 10 + rng.below(sheet.rows - 20)};
    return shot;
}

double distance(const Fix& fix, const Shot& shot) {
    return std::hypot(fix.x_grid() - x_grid(shot.pose), fix.y_grid() - y_grid(shot.pose));
}

template <typename Memory>
class DeviceOnSheets : public testing::Test {
  protected:
    static DeviceOptions options() {
        DeviceOptions options;
        options.blobs.min_area_px = 1;
        return options;
    }
    void know(OtherSheets others) {
        ASSERT_EQ(locator_.set_known({&kSheet, 1}, others), Status::ok);
    }
    Fix tracked(const GreyImage& image, const Prediction& prediction) {
        static_cast<void>(locator_.begin(image.width_px, image.height_px, prediction));
        for (int v = 0; v < image.height_px; ++v)
            locator_.push_row(image.view().row(v));
        return locator_.finish();
    }
    /// Locates the first `rows` rows of an image, without a prediction.
    Fix fresh(const GreyImage& image, int rows) {
        static_cast<void>(locator_.begin(image.width_px, image.height_px));
        for (int v = 0; v < rows; ++v)
            locator_.push_row(image.view().row(v));
        return locator_.finish();
    }
    /// Returns a prediction with errors of up to half a spacing and 4 degrees.
    Prediction disturbed(const Fix& fix, int side_px) {
        const double shift_q16 = 32768 * std::sqrt(rng_.uniform());
        const double direction = rng_.uniform(-std::numbers::pi, std::numbers::pi);
        return moved(Prediction::like(fix), CodeVariant::anoto,
                     {static_cast<std::int32_t>(shift_q16 * std::cos(direction)),
                      static_cast<std::int32_t>(shift_q16 * std::sin(direction))},
                     static_cast<std::int32_t>(rng_.uniform(-4, 4) * 2147483648.0 / 180),
                     {(side_px - 1) * 128, (side_px - 1) * 128});
    }

    Memory memory_;
    DeviceLocator locator_{memory_, options()};
    Rng rng_{6};
};

using MouseSensor = DeviceOnSheets<DeviceMemoryFor<36, 36>>;
using PaperSensor = DeviceOnSheets<DeviceMemory>;

TEST_F(PaperSensor, SevenCellsSufficeIfNoOtherSheetIsPossible) {
    know(OtherSheets::impossible);
    int located = 0;
    for (std::uint64_t i = 0; i < 50; ++i) {
        const Shot shot = shot_on(kSheet, 77, 11, i);
        const Fix fix = locator_.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++located;
        EXPECT_LT(distance(fix, shot), 0.05) << i;
        EXPECT_EQ(fix.prior, Prior::only_sheets);
        EXPECT_EQ(fix.attempt, Attempt::device);
        EXPECT_LE(fix.p_wrong_log2, -30);
    }
    EXPECT_GE(located, 49);
}

TEST_F(PaperSensor, SmallFramesNeedNoMoreDotsThanOnADesktop) {
    know(OtherSheets::impossible);
    int located = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Shot shot = shot_on(kSheet, 40, 6, i);
        const Fix fix = locator_.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++located;
        EXPECT_LT(distance(fix, shot), 0.1) << i;
    }
    EXPECT_GE(located, 97);
}

TEST_F(PaperSensor, OtherSheetsAreLocatedByTheWholePlane) {
    KnownRegion other = kSheet;
    other.first.x += 50'000;
    const Shot shot = shot_on(other, 170, 11, 3);
    const GreyImage image = render(shot);
    know(OtherSheets::possible);
    const Fix fix = locator_.locate(image.view());
    ASSERT_EQ(fix.status, Status::ok);
    EXPECT_EQ(fix.prior, Prior::plane);
    EXPECT_LT(distance(fix, shot), 0.05);
    const Prediction prediction = Prediction::like(fix);
    know(OtherSheets::impossible);
    EXPECT_EQ(locator_.locate(image.view()).status, Status::not_certain);
    EXPECT_EQ(tracked(image, prediction).status, Status::not_tracked);
}

TEST_F(PaperSensor, TracksSmallFrames) {
    know(OtherSheets::impossible);
    int located = 0;
    int found = 0;
    for (std::uint64_t i = 0; i < 40; ++i) {
        const Shot shot = shot_on(kSheet, 96, 11, i);
        const GreyImage image = render(shot);
        const Fix before = locator_.locate(image.view());
        if (before.status != Status::ok) continue;
        ++located;
        const Fix fix = tracked(image, disturbed(before, 96));
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_EQ(fix.attempt, Attempt::tracked);
        EXPECT_EQ(fix.prior, Prior::only_sheets);
        EXPECT_LT(distance(fix, shot), 0.05) << i;
    }
    EXPECT_GE(located, 39);
    EXPECT_GE(10 * found, 9 * located);
}

TEST_F(MouseSensor, LocatesAndTracksFineGrids) {
    const GreyImage first = render(shot_on(kSheet, 36, 5.5, 0));
    EXPECT_EQ(locator_.locate(first.view()).status, Status::image_too_small);
    know(OtherSheets::impossible);
    int located = 0;
    int found = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        const Shot shot = shot_on(kSheet, 36, 5.5, i);
        const GreyImage image = render(shot);
        const Fix before = locator_.locate(image.view());
        if (before.status != Status::ok) continue;
        ++located;
        EXPECT_LT(distance(before, shot), 0.1) << i;
        const Fix fix = tracked(image, disturbed(before, 36));
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_EQ(fix.attempt, Attempt::tracked);
        EXPECT_LT(distance(fix, shot), 0.1) << i;
    }
    EXPECT_GE(located, 30);
    EXPECT_GE(20 * found, 19 * located);
}

TEST_F(MouseSensor, LocatesNineOfTenFrames) {
    know(OtherSheets::impossible);
    int located = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Shot shot = shot_on(kSheet, 36, 6, i);
        const Fix fix = locator_.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++located;
        EXPECT_LT(distance(fix, shot), 0.1) << i;
        EXPECT_LE(fix.p_wrong_log2, -30) << i;
    }
    EXPECT_GE(located, 90);
}

TEST_F(MouseSensor, DesktopsLocateTheSameFramesWithTheEffortOfDevices) {
    know(OtherSheets::impossible);
    DeviceOptions as_device = options();
    as_device.effort = Effort::device;
    Locator desktop(as_device);
    ASSERT_EQ(desktop.set_known({&kSheet, 1}, OtherSheets::impossible), Status::ok);
    for (std::uint64_t i = 0; i < 20; ++i) {
        // The frames contain fewer dots than the device can store as seeds, so the device and the
        // desktop use the same seeds.
        const GreyImage image = render(shot_on(kSheet, 36, 6.5, i));
        const Fix fix = fresh(image, 36);
        const Fix on_desktop = desktop.locate(image.view());
        EXPECT_EQ(on_desktop.status, fix.status);
        EXPECT_EQ(on_desktop.theta_bam, fix.theta_bam);
        EXPECT_EQ(on_desktop.x_grid(), fix.x_grid());
    }
}

TEST_F(MouseSensor, FramesWithMissingRowsAreLocated) {
    know(OtherSheets::impossible);
    int located = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const Shot shot = shot_on(kSheet, 36, 5.5, i);
        const GreyImage image = render(shot);
        const Fix fix = fresh(image, 34);
        EXPECT_LE(fix.dots_seen, locator_.locate(image.view()).dots_seen);
        if (fix.status != Status::ok) continue;
        ++located;
        EXPECT_LT(distance(fix, shot), 0.1) << i;
    }
    EXPECT_GE(located, 15);
    for (const int rows : {0, 1, 23})
        EXPECT_EQ(fresh(render(shot_on(kSheet, 36, 5.5, 0)), rows).status, Status::too_few_dots);
    GreyImage blank = render(shot_on(kSheet, 36, 5.5, 0));
    std::ranges::fill(blank.pixels, std::uint8_t{200});
    EXPECT_EQ(fresh(blank, 36).status, Status::no_contrast);
}

TEST_F(MouseSensor, LocatesFramesWithMoreRowsThanTheMemory) {
    know(OtherSheets::impossible);
    int located = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        Shot shot = shot_on(kSheet, 36, 6, i);
        shot.camera.height_px = 60;
        const Fix fix = locator_.locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++located;
        EXPECT_LT(distance(fix, shot), 0.1) << i;
    }
    EXPECT_GE(located, 18);
}

TEST_F(MouseSensor, DesktopsTrackTheSameFramesWithTheEffortOfDevices) {
    know(OtherSheets::impossible);
    DeviceOptions as_device = options();
    as_device.effort = Effort::device;
    Locator desktop(as_device);
    ASSERT_EQ(desktop.set_known({&kSheet, 1}, OtherSheets::impossible), Status::ok);
    int compared = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const GreyImage image = render(shot_on(kSheet, 36, 5.5, i));
        const Fix before = locator_.locate(image.view());
        if (before.status != Status::ok) continue;
        const Prediction prediction = disturbed(before, 36);
        const Fix fix = tracked(image, prediction);
        if (fix.status != Status::ok) continue;
        const Fix on_desktop = desktop.locate(image.view(), prediction);
        EXPECT_EQ(on_desktop.attempt, Attempt::tracked);
        EXPECT_EQ(on_desktop.theta_bam, fix.theta_bam);
        EXPECT_EQ(on_desktop.x_grid(), fix.x_grid());
        ++compared;
    }
    EXPECT_GE(compared, 8);
}

TEST_F(MouseSensor, TracksFramesWithMoreRowsThanTheMemory) {
    know(OtherSheets::impossible);
    int found = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        Shot shot = shot_on(kSheet, 36, 5.5, i);
        const Fix before = locator_.locate(render(shot).view());
        if (before.status != Status::ok) continue;
        shot.camera.height_px = 60;
        Prediction prediction = disturbed(before, 36);
        prediction.pattern_from_image.centre_q8.y += 12 * 256;
        const Fix fix = tracked(render(shot), prediction);
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_LT(distance(fix, shot), 0.1) << i;
        EXPECT_GT(fix.dots_used, before.dots_used + 4) << i;
    }
    EXPECT_GE(found, 9);
}

TEST_F(MouseSensor, FollowsNoWrongPrediction) {
    know(OtherSheets::impossible);
    for (std::uint64_t i = 0; i < 20; ++i) {
        const GreyImage image = render(shot_on(kSheet, 36, 5.5, i));
        const Fix before = locator_.locate(image.view());
        if (before.status != Status::ok) continue;
        Prediction wrong = disturbed(before, 36);
        wrong.place =
            moved(CodeVariant::anoto, wrong.place, i % 2 == 0 ? 2 : 0, i % 2 == 0 ? 0 : -3);
        EXPECT_EQ(tracked(image, wrong).status, Status::not_tracked) << i;
        GreyImage other = image;
        for (std::uint8_t& grey : other.pixels)
            grey = static_cast<std::uint8_t>(rng_.below(256));
        EXPECT_EQ(tracked(other, disturbed(before, 36)).status, Status::not_tracked) << i;
        std::ranges::fill(other.pixels, std::uint8_t{0});
        EXPECT_EQ(tracked(other, disturbed(before, 36)).status, Status::not_tracked) << i;
    }
}

TEST_F(MouseSensor, InvalidRegionsKeepThePreviousRegions) {
    know(OtherSheets::impossible);
    KnownRegion empty = kSheet;
    empty.rows = 0;
    EXPECT_EQ(locator_.set_known({&empty, 1}), Status::bad_argument);
    EXPECT_EQ(locator_.begin(36, 36), Status::ok);
    EXPECT_EQ(locator_.begin(37, 36), Status::image_too_large);
    EXPECT_EQ(locator_.set_known({}), Status::ok);
    EXPECT_EQ(locator_.begin(36, 36), Status::image_too_small);
}

TEST_F(MouseSensor, AnotherLocatorInTheSameMemoryKnowsNoSheets) {
    know(OtherSheets::impossible);
    DeviceLocator second(memory_);
    EXPECT_EQ(second.begin(36, 36), Status::image_too_small);
}

TEST_F(MouseSensor, SmallFramesOfUnknownSheetsAndNoiseAreRefused) {
    know(OtherSheets::possible);
    KnownRegion other = kSheet;
    other.first.y += 70'000;
    for (std::uint64_t i = 0; i < 20; ++i)
        EXPECT_NE(locator_.locate(render(shot_on(other, 36, 5.5, i)).view()).status, Status::ok);
    GreyImage noise = render(shot_on(kSheet, 36, 5.5, 0));
    for (int side = kMinKnownFrameSide_px; side <= 36; ++side) {
        for (std::uint8_t& grey : noise.pixels)
            grey = static_cast<std::uint8_t>(rng_.below(256));
        EXPECT_NE(locator_.locate({noise.pixels.data(), side, side, 36}).status, Status::ok);
    }
}

}  // namespace
}  // namespace dotpose::core_test::on_sheets_test
