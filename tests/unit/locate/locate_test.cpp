// Tests the whole pipeline on simulated frames. A fix must not depend on the type or the previous
// contents of the memory, on earlier frames, or on whether the frame is passed as an image or row
// by row.
#include "dotpose/locate.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../core/canvas.hpp"
#include "shots.hpp"

namespace dotpose::core_test::locate_test {
namespace {

constexpr std::uint64_t kSeed = 34;

/// Returns frames of the same size. Only some of them can be located.
std::vector<GreyImage> mixed_frames() {
    std::vector<GreyImage> frames;
    for (std::uint64_t i = 0; i < 8; ++i) {
        frames.push_back(render(shot_of({.preset = Preset::nominal}, kSeed, i)));
        frames.push_back(render(shot_of({.preset = Preset::hard}, kSeed, i)));
        const Scene scene = kScenes[static_cast<std::size_t>(i) % kScenes.size()];
        frames.push_back(render_scene(scene, shot_of({.preset = Preset::clean}, kSeed, i)));
    }
    return frames;
}

/// Expects that the status and the number of dots of two fixes are equal. If the status is ok, also
/// expects equal poses, counts, residuals and covariances. The covariances must be equal bit by
/// bit.
void expect_same(const Fix& a, const Fix& b) {
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.dots_seen, b.dots_seen);
    if (a.status != Status::ok) return;
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.fraction_x_q16, b.fraction_x_q16);
    EXPECT_EQ(a.fraction_y_q16, b.fraction_y_q16);
    EXPECT_EQ(a.theta_bam, b.theta_bam);
    EXPECT_EQ(a.section, b.section);
    EXPECT_EQ(a.spacing_px_q16, b.spacing_px_q16);
    EXPECT_EQ(a.dots_used, b.dots_used);
    EXPECT_EQ(a.bit_errors, b.bit_errors);
    EXPECT_EQ(a.p_wrong_log2, b.p_wrong_log2);
    EXPECT_EQ(a.residual_px, b.residual_px);
    EXPECT_EQ(std::memcmp(a.covariance, b.covariance, sizeof a.covariance), 0);
}

/// Locates an image that is passed row by row to a Locator or a DeviceLocator.
template <typename AnyLocator>
Fix pushed(const GreyImage& image, AnyLocator&& locator) {
    static_cast<void>(locator.begin(image.width_px, image.height_px));
    std::vector<std::uint8_t> row(static_cast<std::size_t>(image.width_px));
    for (int v = 0; v < image.height_px; ++v) {
        std::copy_n(image.view().row(v), image.width_px, row.begin());
        locator.push_row(row.data());
        // The locator must not access the pixels after `push_row` has returned.
        std::fill(row.begin(), row.end(), std::uint8_t{0});
    }
    return locator.finish();
}

TEST(Locate, RowsGiveTheSameFixAsTheImage) {
    SmallMemory by_rows;
    SmallMemory at_once;
    int found = 0;
    for (const GreyImage& frame : mixed_frames()) {
        const Fix whole = Locator(at_once).locate(frame.view());
        expect_same(pushed(frame, Locator(by_rows)), whole);
        found += whole.status == Status::ok ? 1 : 0;
    }
    EXPECT_GE(found, 8) << "seed " << kSeed;
}

TEST(Locate, PushedRowsAreTrackedLikeTheImage) {
    SmallMemory by_rows;
    SmallMemory at_once;
    const GreyImage frame = render(shot_of({.preset = Preset::nominal}, kSeed, 3));
    const Prediction prediction = Prediction::like(Locator(at_once).locate(frame.view()));
    Locator locator(by_rows);
    ASSERT_EQ(locator.begin(frame.width_px, frame.height_px, prediction), Status::ok);
    for (int v = 0; v < frame.height_px; ++v)
        locator.push_row(frame.view().row(v));
    const Fix fix = locator.finish();
    EXPECT_EQ(fix.attempt, Attempt::tracked);
    expect_same(fix, Locator(at_once).locate(frame.view(), prediction));
}

TEST(Locate, RowsThatAreMissingAreWhite) {
    SmallMemory memory;
    GreyImage frame = render(shot_of({.preset = Preset::nominal}, kSeed, 3));
    const int half = frame.height_px / 2;
    Locator locator(memory, DeviceOptions{});
    ASSERT_EQ(locator.begin(frame.width_px, frame.height_px), Status::ok);
    for (int v = 0; v < half; ++v)
        locator.push_row(frame.view().row(v));
    const Fix fix = locator.finish();
    std::fill(frame.pixels.begin() + half * frame.width_px, frame.pixels.end(), 255);
    SmallMemory at_once;
    expect_same(fix, Locator(at_once).locate(frame.view()));
}

TEST(Locate, RowsThatTheMemoryCannotKeepAreRefused) {
    SmallMemory memory;
    Locator locator(memory, DeviceOptions{});
    EXPECT_EQ(locator.begin(188, 188), Status::ok);
    EXPECT_EQ(locator.begin(188, 189), Status::image_too_large);
    EXPECT_EQ(locator.finish().status, Status::image_too_large);
}

TEST(Locate, ADeviceGetsTheSameFromRowsAndImage) {
    SmallMemory by_rows;
    SmallMemory at_once;
    DeviceMemory little;
    DeviceOptions device;
    device.effort = Effort::device;
    int found = 0;
    for (const GreyImage& frame : mixed_frames()) {
        const Fix fix = Locator(at_once, device).locate(frame.view());
        expect_same(pushed(frame, Locator(by_rows, device)), fix);
        // A DeviceLocator must give the same fix whether the frame is passed as an image or row by
        // row.
        expect_same(pushed(frame, DeviceLocator(little)),
                    DeviceLocator(little).locate(frame.view()));
        found += fix.status == Status::ok ? 1 : 0;
    }
    EXPECT_GE(found, 7) << "seed " << kSeed;
}

TEST(Locate, ADeviceLocatesNominalFrames) {
    SmallMemory memory;
    DeviceOptions device;
    device.effort = Effort::device;
    std::vector<double> errors_um;
    constexpr std::uint64_t kFrames = 200;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const Shot shot = shot_of({.preset = Preset::nominal}, kSeed, i);
        const Fix fix = Locator(memory, device).locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        const double spacing_um = 1000 * shot.page.pattern.spacing_mm;
        errors_um.push_back(
            std::hypot(fix.x_grid() - x_grid(shot.pose), fix.y_grid() - y_grid(shot.pose)) *
            spacing_um);
        // A fix with a larger error would be at the wrong place.
        EXPECT_LT(errors_um.back(), 0.1 * spacing_um);
        EXPECT_EQ(fix.section, shot.page.pattern.section);
        EXPECT_LT(
            std::abs(std::remainder(fix.theta_rad() - shot.pose.theta_rad, 2 * std::numbers::pi)),
            0.01);
        EXPECT_LE(fix.p_wrong_log2, device.integrity.max_p_wrong_log2);
        EXPECT_GE(fix.dots_used, 36);
        // A device does not compute the residual or the covariance, because they are floating-point
        // values.
        EXPECT_EQ(fix.residual_px, 0);
        for (const auto& row : fix.covariance)
            EXPECT_THAT(row, testing::Each(0.0F));
    }
    EXPECT_GE(errors_um.size(), kFrames * 97 / 100);
    std::sort(errors_um.begin(), errors_um.end());
    EXPECT_LT(errors_um[errors_um.size() / 2], 1.3) << "seed " << kSeed;
}

TEST(Locate, LittleMemoryIsEnoughForADevice) {
    DeviceMemory little;
    SmallMemory small;
    DeviceOptions device;
    device.effort = Effort::device;
    int found = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const GreyImage frame = render(shot_of({.preset = Preset::nominal}, kSeed, i));
        const Fix fix = pushed(frame, Locator(small, device));
        expect_same(pushed(frame, DeviceLocator(little)), fix);
        found += fix.status == Status::ok;
        // Frames with noise and graphics fill the memory. They must have no effect on later frames.
        const Shot hard = shot_of({.preset = Preset::hard}, kSeed, i);
        const Fix full = pushed(render(hard), DeviceLocator(little));
        if (full.status == Status::ok) {
            EXPECT_NEAR(full.x_grid(), x_grid(hard.pose), 0.2);
            EXPECT_NEAR(full.y_grid(), y_grid(hard.pose), 0.2);
        }
        const GreyImage noise =
            render_scene(Scene::noise, shot_of({.preset = Preset::clean}, kSeed, i), 0.3);
        EXPECT_NE(pushed(noise, DeviceLocator(little)).status, Status::ok);
    }
    EXPECT_GE(found, 57) << "seed " << kSeed;
    EXPECT_EQ(DeviceLocator(little).begin(189, 120), Status::image_too_large);
}

TEST(Locate, ADeviceRefusesWhatHasNoPosition) {
    SmallMemory memory;
    DeviceOptions device;
    device.effort = Effort::device;
    for (const Scene scene : kScenes) {
        for (std::uint64_t i = 0; i < 20; ++i) {
            const GreyImage frame =
                render_scene(scene, shot_of({.preset = Preset::clean}, kSeed, i), 0.8);
            EXPECT_NE(Locator(memory, device).locate(frame.view()).status, Status::ok)
                << name(scene) << ", shot " << i << ", seed " << kSeed;
        }
    }
}

TEST(Locate, SmallAndLargeMemoryGiveTheSameFix) {
    SmallMemory small;
    const auto large = std::make_unique<LargeMemory>();
    for (const GreyImage& frame : mixed_frames()) {
        expect_same(Locator(small, DeviceOptions{}).locate(frame.view()),
                    Locator(*large, DeviceOptions{}).locate(frame.view()));
    }
}

TEST(Locate, UsedMemoryIsAsGoodAsFreshOne) {
    // Before a frame is located, the locator processes frames of other sizes and frames that it
    // refuses. These frames must have no effect.
    const auto used_memory = std::make_unique<LargeMemory>();
    Locator used(*used_memory, DeviceOptions{});
    const GreyImage big = render(shot_of({.width_px = 640, .height_px = 480}, kSeed, 3));
    const GreyImage tiny = blank(10, 10);
    for (const GreyImage& frame : mixed_frames()) {
        const auto fresh_memory = std::make_unique<LargeMemory>();
        const Fix fresh = Locator(*fresh_memory, DeviceOptions{}).locate(frame.view());
        expect_same(used.locate(frame.view()), fresh);
        EXPECT_EQ(used.locate(big.view()).status, Status::ok);
        expect_same(used.locate(frame.view()), fresh);
        EXPECT_EQ(used.locate(tiny.view()).status, Status::image_too_small);
        // Begins the frame, and abandons it after 50 rows.
        EXPECT_EQ(used.begin(frame.width_px, frame.height_px), Status::ok);
        for (int v = 0; v < 50; ++v)
            used.push_row(frame.view().row(v));
    }
}

TEST(Locate, TheTraceKeepsTheFix) {
    SmallMemory memory;
    const GreyImage frame = render(shot_of({.preset = Preset::nominal}, kSeed, 0));
    DeviceOptions options;
    options.show_stages = true;
    Locator locator(memory, options);
    const Fix fix = locator.locate(frame.view());
    ASSERT_EQ(fix.status, Status::ok);
    expect_same(fix, locator.trace().fix);
    // Dots without clear bits are counted in `dots_seen`, but are not stored in the trace.
    const int kept = static_cast<int>(locator.trace().dots.size());
    EXPECT_GE(fix.dots_seen, kept);
    EXPECT_GE(kept, fix.dots_used);
}

TEST(Locate, RowsCountOnlyInAFrameThatWasBegun) {
    SmallMemory memory;
    const GreyImage frame = render(shot_of({.preset = Preset::nominal}, kSeed, 0));
    Locator locator(memory, DeviceOptions{});
    locator.push_row(frame.pixels.data());
    EXPECT_EQ(locator.finish().status, Status::bad_argument);
    EXPECT_EQ(locator.begin(63, 120), Status::image_too_small);
    EXPECT_EQ(locator.finish().status, Status::image_too_small);
    EXPECT_EQ(pushed(frame, locator).status, Status::ok);
    EXPECT_EQ(locator.finish().status, Status::bad_argument);
    // Rows beyond the height of the frame are ignored.
    const Fix fix = pushed(frame, locator);
    ASSERT_EQ(locator.begin(frame.width_px, frame.height_px), Status::ok);
    for (int v = 0; v < 3 * frame.height_px; ++v)
        locator.push_row(frame.view().row(v % frame.height_px));
    expect_same(locator.finish(), fix);
    // Changing the options in the middle of a frame discards the frame.
    ASSERT_EQ(locator.begin(frame.width_px, frame.height_px), Status::ok);
    locator.set_options({});
    EXPECT_EQ(locator.finish().status, Status::bad_argument);
}

TEST(Locate, MillimetresComeFromTheSpacingInTheOptions) {
    SmallMemory memory;
    const GreyImage frame = render(shot_of({.preset = Preset::nominal}, kSeed, 0));
    DeviceOptions options;
    options.spacing_nm = 300'000;
    const Fix fix = Locator(memory, options).locate(frame.view());
    ASSERT_EQ(fix.status, Status::ok);
    EXPECT_DOUBLE_EQ(fix.x_mm(), fix.x_grid() * 0.3);
    EXPECT_DOUBLE_EQ(fix.y_mm(), fix.y_grid() * 0.3);
    options.spacing_nm = 0;
    EXPECT_TRUE(std::isnan(Locator(memory, options).locate(frame.view()).x_mm()));
}

TEST(Locate, RowsMayLieApartOrUpsideDown) {
    SmallMemory memory;
    const GreyImage frame = render(shot_of({.preset = Preset::nominal}, kSeed, 1));
    const Fix fix = Locator(memory, DeviceOptions{}).locate(frame.view());
    ASSERT_EQ(fix.status, Status::ok);
    for (const int stride : {188, 189, 256, 1000, -188, -300}) {
        const int step = std::abs(stride);
        std::vector<std::uint8_t> pixels(static_cast<std::size_t>(step) * 120, 77);
        const auto row = [&](int v) { return pixels.data() + (stride > 0 ? v : 119 - v) * step; };
        for (int v = 0; v < 120; ++v)
            std::copy_n(frame.view().row(v), 188, row(v));
        expect_same(Locator(memory, DeviceOptions{}).locate({row(0), 188, 120, stride}), fix);
    }
}

TEST(Locate, TheReferencePointMayLieAnywhere) {
    SmallMemory memory;
    for (std::uint64_t i = 0; i < 10; ++i) {
        const Shot shot = shot_of({.preset = Preset::clean}, kSeed, i);
        const GreyImage frame = render(shot);
        const Fix at_centre = Locator(memory, DeviceOptions{}).locate(frame.view());
        ASSERT_EQ(at_centre.status, Status::ok);
        for (const Vec2 offset :
             {Vec2{0, 0}, Vec2{40.5, -20.25}, Vec2{-93.5, 59.5}, Vec2{500, 300}}) {
            SCOPED_TRACE(testing::Message()
                         << "shot " << i << ", seed " << kSeed << ", offset " << offset.x);
            DeviceOptions options;
            options.reference_dx_q8 = static_cast<std::int32_t>(offset.x * 256);
            options.reference_dy_q8 = static_cast<std::int32_t>(offset.y * 256);
            const Fix fix = Locator(memory, options).locate(frame.view());
            ASSERT_EQ(fix.status, Status::ok);
            // Pattern point at the pixel according to the camera model, in spacings relative to the
            // true pose.
            const Vec2 pixel = Vec2{93.5, 59.5} + offset;
            const Vec2 from_pose = 1 / kDefaultSpacing_mm *
                                   Projection(shot.camera, shot.pose).offset_from_pixel(pixel);
            const double x = fix.x_grid() - shot.pose.cell.x - shot.pose.fraction_x;
            const double y = fix.y_grid() - shot.pose.cell.y - shot.pose.fraction_y;
            // The tolerance is 1/100 spacing at the image centre, and increases with the distance
            // from the centre.
            const double tolerance = 0.01 + length(offset) * 1e-4;
            EXPECT_NEAR(x, from_pose.x, tolerance);
            EXPECT_NEAR(y, from_pose.y, tolerance);
            // The fit may interpret noise as a slight tilt. The direction of the axes therefore
            // varies across the image, and varies more outside the image.
            const double apart_rad =
                std::remainder(fix.theta_rad() - at_centre.theta_rad(), 2 * std::numbers::pi);
            EXPECT_NEAR(apart_rad, 0, 1e-4 * std::max(1.0, length(offset) / 100));
        }
    }
}

TEST(Locate, ALensIsUndone) {
    SmallMemory memory;
    for (std::uint64_t i = 0; i < 10; ++i) {
        Shot shot = shot_of({.preset = Preset::clean}, kSeed, i);
        shot.camera.k = -1.5e-5;
        const GreyImage frame = render(shot);
        DeviceOptions options;
        options.lens = FixedLens::from_k(shot.camera.k);
        const Fix fix = Locator(memory, options).locate(frame.view());
        ASSERT_EQ(fix.status, Status::ok) << "shot " << i << ", seed " << kSeed;
        EXPECT_NEAR(fix.x_grid() - shot.pose.cell.x, shot.pose.fraction_x, 0.01);
        EXPECT_NEAR(fix.y_grid() - shot.pose.cell.y, shot.pose.fraction_y, 0.01);
        EXPECT_NEAR(std::remainder(fix.theta_rad() - shot.pose.theta_rad, 2 * std::numbers::pi), 0,
                    0.001);
    }
}

// At the positions predicted by the code, the second attempt also measures dots that were not found
// as blobs. These dots must also be counted as seen.
TEST(Locate, UsesNoMoreDotsThanItSaw) {
    SmallMemory memory;
    int by_second = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const Fix fix = Locator(memory, DeviceOptions{})
                            .locate(render(shot_of({.preset = Preset::hard}, kSeed, i)).view());
        if (fix.status != Status::ok) continue;
        by_second += fix.attempt == Attempt::second;
        EXPECT_LE(fix.dots_used, fix.dots_seen) << "shot " << i << ", seed " << kSeed;
    }
    EXPECT_GT(by_second, 10);
}

}  // namespace
}  // namespace dotpose::core_test::locate_test
