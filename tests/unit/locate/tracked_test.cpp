// Tests the tracked attempt with correct, inaccurate, wrong and invalid predictions.
#include "locate/tracked.hpp"

#include <gtest/gtest.h>

#include "../core/planes.hpp"
#include "locate/workspace.hpp"
#include "shots.hpp"

namespace dotpose::core_test::tracked_test {
namespace {

constexpr std::uint64_t kSeed = 71;
constexpr double kBamPerRadian = 2147483648.0 / std::numbers::pi;

std::int32_t bam(double rad) {
    return static_cast<std::int32_t>(std::lround(rad * kBamPerRadian));
}

/// Returns a prediction that agrees exactly with the shot, including the tilt of the camera.
Prediction true_prediction(const Shot& shot) {
    Prediction prediction;
    const Pattern& pattern = shot.page.pattern;
    const Vec2 centre{(shot.camera.width_px - 1) / 2.0, (shot.camera.height_px - 1) / 2.0};
    const Projection projection(shot.camera, shot.pose);
    const auto at = [&](double x, double y) {
        return 1 / pattern.spacing_mm * projection.offset_from_pixel({centre.x + x, centre.y + y});
    };
    PlaneFromImage& plane = prediction.pattern_from_image;
    plane.centre_q8 = fixed(centre, 8);
    plane.at_centre_q16 = fixed({shot.pose.fraction_x, shot.pose.fraction_y}, 16);
    plane.du_q24 = fixed(0.5 * (at(1, 0) - at(-1, 0)), 24);
    plane.dv_q24 = fixed(0.5 * (at(0, 1) - at(0, -1)), 24);
    // On the image x axis, the pattern point shown at distance x from the centre is at(x, 0) = du x
    // / (1 + tilt x). The tilt is computed from two opposite points, x and -x.
    constexpr double kFar_px = 50;
    const auto tilt = [](Vec2 ahead, Vec2 behind) {
        const double a = length(ahead);
        const double b = length(behind);
        return (b - a) / (a + b) / kFar_px;
    };
    plane.perspective_q30 =
        fixed({tilt(at(kFar_px, 0), at(-kFar_px, 0)), tilt(at(0, kFar_px), at(0, -kFar_px))}, 30);
    prediction.place = {shot.pose.cell, pattern.section};
    return prediction;
}

Prediction turned_and_moved(const Shot& shot, const Prediction& prediction, Vec2 by,
                            double turn_rad) {
    return moved(prediction, shot.page.pattern.code, fixed(by, 16), bam(turn_rad),
                 prediction.pattern_from_image.centre_q8);
}

Fix tracked(const GreyImage& image, const Prediction& prediction, const DeviceOptions& options = {},
            const core::Kernels& kernels = core::kernels()) {
    core::DesktopWorkspace& w = large_workspace();
    w.work = core::WorkLimit(core::WorkLimit::kOfImage);
    if (core::locate_tracked(w.frame(kernels, image.view(), options), prediction, w)) {
        EXPECT_EQ(w.fix.status, Status::ok);
        EXPECT_EQ(w.fix.attempt, Attempt::tracked);
        return w.fix;
    }
    Fix none;
    none.status = Status::not_tracked;
    return none;
}

DeviceOptions options_for(const Shot& shot) {
    DeviceOptions options;
    options.code = shot.page.pattern.code;
    return options;
}

/// Returns wrong predictions. Some are displaced by whole cells, rotated by quarter turns, or in
/// another section. One is at a random place.
std::vector<Prediction> wrong_predictions(const Shot& shot, Rng& rng) {
    const Prediction truth = true_prediction(shot);
    std::vector<Prediction> wrong;
    for (const Vec2 by : {Vec2{1, 0}, {0, -1}, {2, 1}, {-2, 0}, {63, 0}, {0, 236}})
        wrong.push_back(turned_and_moved(shot, truth, by, 0));
    for (const int quarters : {1, 2, 3})
        wrong.push_back(turned_and_moved(shot, truth, {}, quarters * std::numbers::pi / 2));
    Prediction elsewhere = truth;
    elsewhere.place.section.u =
        static_cast<std::uint8_t>((truth.place.section.u + 1 + rng.below(62)) % 63);
    wrong.push_back(elsewhere);
    elsewhere = truth;
    elsewhere.place.section.v =
        static_cast<std::uint8_t>((truth.place.section.v + 1 + rng.below(62)) % 63);
    wrong.push_back(elsewhere);
    elsewhere = truth;
    elsewhere.place = random_place(rng);
    wrong.push_back(elsewhere);
    return wrong;
}

TEST(LocateTracked, FindsTheTruthFromItself) {
    for (const double spacing_px : {6.0, 8.0, 11.0, 20.0, 40.0}) {
        const double scale = spacing_px / 11;
        const ShotSize size{spacing_px, static_cast<int>(188 * std::max(scale, 0.8)),
                            static_cast<int>(120 * std::max(scale, 0.8))};
        for (std::uint64_t i = 0; i < 6; ++i) {
            SCOPED_TRACE(testing::Message() << spacing_px << " px, shot " << i);
            const Shot shot = shot_of(size, kSeed, i);
            const Fix fix = tracked(render(shot), true_prediction(shot));
            ASSERT_EQ(fix.status, Status::ok);
            EXPECT_TRUE(is_right(fix, shot));
            EXPECT_NEAR(fix.x_grid(), x_grid(shot.pose), 0.02);
            EXPECT_NEAR(fix.y_grid(), y_grid(shot.pose), 0.02);
            EXPECT_LE(fix.p_wrong_log2, -30);
        }
    }
}

TEST(LocateTracked, FindsWhatIsHalfASpacingAndFourDegreesOff) {
    Rng rng(kSeed);
    int found = 0;
    constexpr int kFrames = 80;
    for (int i = 0; i < kFrames; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const Shot shot = shot_of({}, kSeed, static_cast<std::uint64_t>(i));
        const double direction = rng.uniform(0, 6.28);
        const double off = 0.5 * rng.uniform();
        const Prediction prediction = turned_and_moved(
            shot, true_prediction(shot), {off * std::cos(direction), off * std::sin(direction)},
            radians(rng.uniform(-4, 4)));
        const Fix fix = tracked(render(shot), prediction);
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_TRUE(is_right(fix, shot));
    }
    EXPECT_GE(found, kFrames * 99 / 100);
}

TEST(LocateTracked, FollowsTheFixOfTheFrameBefore) {
    for (std::uint64_t i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        Shot shot = shot_of({}, kSeed, i);
        Fix fix = Locator(large_memory(), DeviceOptions{}).locate(render(shot).view());
        ASSERT_EQ(fix.status, Status::ok);
        // The brightness is halved, and the camera moves a little.
        shot.imperfections.paper_level *= 0.5;
        shot.pose.fraction_x += 0.2;
        shot.pose.theta_rad += radians(1);
        fix = tracked(render(shot), Prediction::like(fix));
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_TRUE(is_right(fix, shot));
    }
}

TEST(LocateTracked, FollowsATiltedCamera) {
    int found = 0;
    for (std::uint64_t i = 0; i < 30; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        Shot shot = shot_of({}, kSeed, i);
        shot.pose.tilt_x_rad = radians(20 * std::cos(static_cast<double>(i)));
        shot.pose.tilt_y_rad = radians(20 * std::sin(static_cast<double>(i)));
        const GreyImage image = render(shot);
        const Fix fix =
            tracked(image, turned_and_moved(shot, true_prediction(shot), {0.1, -0.1}, 0.01));
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_TRUE(is_right(fix, shot));
        // The same image is tracked with the prediction from its own fix.
        const Fix again = tracked(image, Prediction::like(fix));
        EXPECT_EQ(again.status, Status::ok);
        EXPECT_NEAR(again.x_grid(), fix.x_grid(), 0.003);
        EXPECT_NEAR(again.y_grid(), fix.y_grid(), 0.003);
    }
    EXPECT_GE(found, 28);
}

TEST(LocateTracked, AWrongPredictionGivesNoWrongFix) {
    Rng rng(kSeed);
    for (int i = 0; i < 30; ++i) {
        Shot shot = shot_of({.code = kCodeVariants[static_cast<std::size_t>(i % 3)]}, kSeed,
                            static_cast<std::uint64_t>(i));
        const GreyImage image = render(shot);
        const DeviceOptions options = options_for(shot);
        int number = 0;
        for (const Prediction& wrong : wrong_predictions(shot, rng)) {
            SCOPED_TRACE(testing::Message() << "shot " << i << ", prediction " << number++);
            const Fix fix = tracked(image, wrong, options);
            EXPECT_TRUE(fix.status != Status::ok || is_right(fix, shot));
            const Fix located = Locator(large_memory(), options).locate(image.view(), wrong);
            EXPECT_EQ(located.status, Status::ok);
            EXPECT_TRUE(is_right(located, shot));
        }
    }
}

TEST(LocateTracked, WhatShowsNoPatternGivesNoFix) {
    for (const Scene scene : kScenes) {
        if (scene == Scene::seam_vertical || scene == Scene::seam_horizontal) continue;
        for (std::uint64_t i = 0; i < 6; ++i) {
            SCOPED_TRACE(testing::Message() << name(scene) << " " << i);
            const Shot shot = shot_of({}, kSeed, i);
            const GreyImage image = render_scene(scene, shot, 0.3 + 0.1 * static_cast<double>(i));
            EXPECT_EQ(tracked(image, true_prediction(shot)).status, Status::not_tracked);
            const Fix fix = Locator(large_memory(), DeviceOptions{})
                                .locate(image.view(), true_prediction(shot));
            EXPECT_NE(fix.status, Status::ok);
        }
    }
}

TEST(LocateTracked, AllFormsOfTheKernelsGiveTheSame) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 24; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const ShotSize size{i % 3 == 0 ? 20.0 : 9.0, 188 + 7 * i, 120 + 5 * i,
                            i % 4 == 3 ? Preset::hard : Preset::nominal};
        const Shot shot = shot_of(size, kSeed, static_cast<std::uint64_t>(i));
        const GreyImage image = render(shot);
        const Prediction prediction = turned_and_moved(
            shot, true_prediction(shot), {rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)},
            radians(rng.uniform(-2, 2)));
        const auto forms = kernel_forms();
        const Fix reference = tracked(image, prediction, {}, *forms[0]);
        found += reference.status == Status::ok;
        for (const core::Kernels* form : forms) {
            SCOPED_TRACE(form->name);
            expect_same_bits(tracked(image, prediction, {}, *form), reference);
        }
    }
    EXPECT_GE(found, 18);
}

std::int32_t any_number(Rng& rng) {
    switch (rng.below(6)) {
        case 0:
            return INT32_MAX;
        case 1:
            return INT32_MIN;
        case 2:
            return 0;
        case 3:
            return static_cast<std::int32_t>(rng.bits()) >> rng.below(32);
        default:
            return static_cast<std::int32_t>(rng.bits());
    }
}

/// Returns a copy of the prediction in which some fields have random values.
Prediction garbled(Prediction p, Rng& rng) {
    PlaneFromImage& plane = p.pattern_from_image;
    const std::array numbers{&plane.centre_q8.x,
                             &plane.centre_q8.y,
                             &plane.at_centre_q16.x,
                             &plane.at_centre_q16.y,
                             &plane.du_q24.x,
                             &plane.du_q24.y,
                             &plane.dv_q24.x,
                             &plane.dv_q24.y,
                             &plane.perspective_q30.x,
                             &plane.perspective_q30.y,
                             &plane.lens_q40,
                             &p.displacement_q16,
                             &p.sigma_q16,
                             &p.sigma_theta_bam};
    // Randomises either a single field or about half of the fields.
    const std::uint32_t fraction = rng.below(2) == 0 ? 1 : 8;
    const std::size_t one = rng.below(static_cast<std::uint32_t>(numbers.size() + 4));
    const auto is_hit = [&](std::size_t i) { return i == one || rng.below(16) < fraction - 1; };
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (is_hit(i)) *numbers[i] = any_number(rng);
    }
    const auto any = [&] { return static_cast<std::uint32_t>(any_number(rng)); };
    if (is_hit(numbers.size())) p.place.cell.x = any();
    if (is_hit(numbers.size() + 1)) p.place.cell.y = any();
    if (is_hit(numbers.size() + 2)) p.place.section.u = static_cast<std::uint8_t>(any());
    if (is_hit(numbers.size() + 3)) p.place.section.v = static_cast<std::uint8_t>(any());
    return p;
}

TEST(LocateTracked, NonsenseNeitherBreaksNorDeceives) {
    Rng rng(kSeed);
    constexpr std::array kSizes{ShotSize{6, 64, 64}, ShotSize{11, 188, 120}, ShotSize{8, 65, 301},
                                ShotSize{30, 400, 300}};
    for (int i = 0; i < 24; ++i) {
        const Shot shot = shot_of(kSizes[static_cast<std::size_t>(i) % kSizes.size()], kSeed,
                                  static_cast<std::uint64_t>(i));
        const GreyImage image = i % 6 == 5 ? render_scene(Scene::noise, shot, 0.4) : render(shot);
        const Prediction truth = true_prediction(shot);
        for (int k = 0; k < 400; ++k) {
            SCOPED_TRACE(testing::Message() << "shot " << i << ", prediction " << k);
            const Prediction nonsense = garbled(truth, rng);
            DeviceOptions options;
            options.show_stages = k % 4 == 0;
            const Fix fix = tracked(image, nonsense, options);
            ASSERT_TRUE(fix.status != Status::ok || is_right(fix, shot));
            if (k % 40 != 0) continue;
            const Fix located =
                Locator(large_memory(), DeviceOptions{}).locate(image.view(), nonsense);
            ASSERT_TRUE(located.status != Status::ok || is_right(located, shot));
        }
    }
}

TEST(LocateTracked, RefusesPlacesThatTheCodeDoesNotHave) {
    const Shot shot = shot_of({}, kSeed, 1);
    const GreyImage image = render(shot);
    const Prediction truth = true_prediction(shot);
    ASSERT_EQ(tracked(image, truth).status, Status::ok);
    for (int field = 0; field < 4; ++field) {
        Prediction p = truth;
        if (field == 0) p.place.cell.x += kPositionsPerAxis;
        if (field == 1) p.place.cell.y += kPositionsPerAxis;
        if (field == 2) p.place.section.u = static_cast<std::uint8_t>(p.place.section.u + 63);
        if (field == 3) p.place.section.v = static_cast<std::uint8_t>(p.place.section.v + 63);
        EXPECT_EQ(tracked(image, p).status, Status::not_tracked) << field;
    }
}

}  // namespace
}  // namespace dotpose::core_test::tracked_test
