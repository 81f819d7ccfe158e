// Tests that the tracked attempt on devices confirms correct predictions and refuses wrong
// predictions.
#include "device/tracked.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "code/rolls.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::core_test::device_tracked_test {
namespace {

constexpr double kBamPerDegree = 4294967296.0 / 360;

Shot shot_of(std::uint64_t index, Preset preset = Preset::nominal, double mm_per_px = 0.046) {
    Setup setup;
    setup.preset = preset;
    setup.seed = 77;
    setup.camera.mm_per_px = mm_per_px;
    return draw_shot(setup, index);
}

double x_off(const Fix& fix, const Shot& shot) {
    return std::remainder(fix.x_grid() - x_grid(shot.pose), double{kPositionsPerAxis});
}
double y_off(const Fix& fix, const Shot& shot) {
    return std::remainder(fix.y_grid() - y_grid(shot.pose), double{kPositionsPerAxis});
}

/// Returns true if the position is within 0.3 spacings of the truth and the section is correct.
bool is_right(const Fix& fix, const Shot& shot) {
    return std::hypot(x_off(fix, shot), y_off(fix, shot)) < 0.3 &&
           fix.section == shot.page.pattern.section;
}

class DeviceTracked : public testing::Test {
  protected:
    /// Locates an image using only the tracked attempt on the device.
    Fix tracked(const GreyImage& image, const Prediction& prediction) {
        static_cast<void>(locator_.begin(image.width_px, image.height_px, prediction));
        for (int v = 0; v < image.height_px; ++v)
            locator_.push_row(image.view().row(v));
        return locator_.finish();
    }
    Fix fresh(const GreyImage& image) { return locator_.locate(image.view()); }

    Prediction disturbed(const Prediction& prediction, double shift, double turn_deg) {
        const double direction = rng_.uniform(-std::numbers::pi, std::numbers::pi);
        return moved(prediction, CodeVariant::anoto,
                     {static_cast<std::int32_t>(65536 * shift * std::cos(direction)),
                      static_cast<std::int32_t>(65536 * shift * std::sin(direction))},
                     static_cast<std::int32_t>(turn_deg * kBamPerDegree), {187 * 128, 119 * 128});
    }
    Prediction disturbed(const Prediction& prediction) {
        return disturbed(prediction, 0.5 * std::sqrt(rng_.uniform()), rng_.uniform(-4, 4));
    }

    DeviceMemory memory_;
    DeviceLocator locator_{memory_};
    Rng rng_{5};
};

TEST_F(DeviceTracked, FollowsPredictionsThatAreOffByHalfASpacingAndFourDegrees) {
    int predicted = 0;
    int found = 0;
    double squares = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const Shot shot = shot_of(i);
        const GreyImage image = render(shot);
        const Fix before = fresh(image);
        if (before.status != Status::ok) continue;
        ++predicted;
        const Fix fix = tracked(image, disturbed(Prediction::like(before)));
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_EQ(fix.attempt, Attempt::tracked);
        EXPECT_TRUE(is_right(fix, shot)) << i;
        EXPECT_LE(fix.p_wrong_log2, -30);
        EXPECT_GT(fix.dots_used, 100);
        EXPECT_NEAR(fix.theta_bam / kBamPerDegree, before.theta_bam / kBamPerDegree, 0.2);
        EXPECT_NEAR(fix.displacement_q16, before.displacement_q16, 2000);
        squares += x_off(fix, shot) * x_off(fix, shot) + y_off(fix, shot) * y_off(fix, shot);
    }
    EXPECT_GE(100 * found, 99 * predicted) << found << " of " << predicted;
    EXPECT_LT(std::sqrt(squares / found), 0.004);
}

TEST_F(DeviceTracked, FollowsPaleDots) {
    int predicted = 0;
    int found = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        // At 8.3 px per spacing, dots are hardly larger than a pixel, so blur makes them pale.
        const Shot shot = shot_of(i, Preset::nominal, 0.0612);
        const GreyImage image = render(shot);
        const Fix before = fresh(image);
        if (before.status != Status::ok) continue;
        ++predicted;
        const Fix fix = tracked(image, disturbed(Prediction::like(before)));
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_TRUE(is_right(fix, shot)) << i;
    }
    EXPECT_GE(predicted, 40);
    EXPECT_GE(100 * found, 88 * predicted) << found << " of " << predicted;
}

TEST_F(DeviceTracked, GoesOnFromItsOwnFixes) {
    Shot shot = shot_of(3);
    Fix fix = fresh(render(shot));
    ASSERT_EQ(fix.status, Status::ok);
    for (int i = 0; i < 20; ++i) {
        shot.pose.fraction_x += 0.3;
        shot.pose.fraction_y -= 0.2;
        shot.pose.theta_rad += 0.03;
        shot.seed += 1;
        // The light changes from frame to frame, as if clouds were passing.
        shot.imperfections.paper_level = 230 - 90 * (i % 2);
        fix = locator_.locate(render(shot).view(), Prediction::like(fix));
        ASSERT_EQ(fix.status, Status::ok) << i;
        EXPECT_EQ(fix.attempt, Attempt::tracked) << i;
        EXPECT_LT(std::hypot(x_off(fix, shot), y_off(fix, shot)), 0.02) << i;
    }
}

TEST_F(DeviceTracked, FollowsTheShearOfRollingShutters) {
    Locator desktop;
    struct Motion {
        double px;          ///< motion of the scene during the readout
        int min_predicted;  ///< minimum number of frames, out of 40, that a desktop locates
        int min_percent;    ///< minimum percentage of these frames that a device tracks
    };
    for (const Motion& motion : {Motion{24, 40, 85}, Motion{36, 38, 65}, Motion{72, 28, 55}}) {
        int predicted = 0;
        int found = 0;
        for (std::uint64_t i = 0; i < 40; ++i) {
            Shot shot = shot_of(i);
            const double direction = rng_.uniform(-std::numbers::pi, std::numbers::pi);
            shot.camera.readout_px = {motion.px * std::cos(direction),
                                      motion.px * std::sin(direction)};
            const Fix before = desktop.locate(render(shot).view());
            if (before.status != Status::ok) continue;
            ++predicted;
            shot.seed += 1'000'000;
            const Fix fix = tracked(render(shot), disturbed(Prediction::like(before), 0.2, 1));
            if (fix.status != Status::ok) continue;
            ++found;
            EXPECT_LT(std::hypot(x_off(fix, shot), y_off(fix, shot)), 0.015) << i;
        }
        EXPECT_GE(predicted, motion.min_predicted) << motion.px;
        EXPECT_GE(100 * found, motion.min_percent * predicted)
            << found << " of " << predicted << " at " << motion.px << " px";
    }
}

/// Motion by 60 % of the image height during the readout stretches the cells to twice their height,
/// so that the frame has only four or five rows of cells.
TEST_F(DeviceTracked, FollowsTheShearOfRollingShuttersOnAKnownSheet) {
    Locator desktop{DeviceOptions{}};
    int found = 0;
    constexpr int kFrames = 60;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        Shot shot = shot_of(i);
        const KnownRegion sheet{CodeVariant::anoto,
                                shot.page.pattern.section,
                                {shot.pose.cell.x - 200, shot.pose.cell.y - 280},
                                393,
                                564};
        ASSERT_EQ(desktop.set_known({&sheet, 1}, OtherSheets::possible), Status::ok);
        ASSERT_EQ(locator_.set_known({&sheet, 1}, OtherSheets::possible), Status::ok);
        const double direction = rng_.uniform(-std::numbers::pi, std::numbers::pi);
        constexpr double kMotion_px = 72;
        shot.camera.readout_px = {kMotion_px * std::cos(direction),
                                  kMotion_px * std::sin(direction)};
        const Fix before = desktop.locate(render(shot).view());
        ASSERT_EQ(before.status, Status::ok) << i;
        shot.seed += 1'000'000;
        const Fix fix = tracked(render(shot), disturbed(Prediction::like(before), 0.2, 1));
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_LT(std::hypot(x_off(fix, shot), y_off(fix, shot)), 0.015) << i;
    }
    EXPECT_GE(found, kFrames - 1);
}

TEST_F(DeviceTracked, LocatesAfreshWhatItRefuses) {
    const Shot shot = shot_of(4);
    const GreyImage image = render(shot);
    const Fix before = fresh(image);
    ASSERT_EQ(before.status, Status::ok);
    Prediction prediction = Prediction::like(before);
    prediction.place.section.u = static_cast<std::uint8_t>((prediction.place.section.u + 1) % 63);
    EXPECT_EQ(tracked(image, prediction).status, Status::not_tracked);
    const Fix fix = locator_.locate(image.view(), prediction);
    EXPECT_EQ(fix.status, Status::ok);
    EXPECT_EQ(fix.attempt, Attempt::device);
    EXPECT_EQ(fix.cell, before.cell);
}

/// Returns the wrong place whose first 20 columns are hardest to distinguish from those of `place`.
/// The wrong place differs in one secondary sequence and in the section. It has the maximum number
/// of equal rolls.
Place worst_alternative(Place place) {
    constexpr std::size_t kLines = 20;
    const code::Basis& basis = code::basis(CodeVariant::anoto);
    std::array<std::uint32_t, 4> places;
    for (std::size_t k = 0; k < 4; ++k)
        places[k] = basis[k].place_of(place.cell.x);
    int most = 0;
    Place alternative = place;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::uint32_t other = 0; other < basis[k].length; ++other) {
            if (other == places[k]) continue;
            std::array<int, kSections> shared{};
            for (std::size_t line = 0; line < kLines; ++line) {
                const int grown =
                    basis[k].rolls[other + line] - basis[k].rolls[places[k] + line] + kSections;
                const int count = ++shared[static_cast<std::size_t>(grown % kSections)];
                if (count <= most) continue;
                most = count;
                std::array<std::uint32_t, 4> there = places;
                there[k] = other;
                alternative.cell.x = code::position_at(basis, there);
                const int here = code::roll_from(CodeVariant::anoto, place.cell.x, place.section.u,
                                                 place.cell.y);
                const int wanted = (here + kSections - grown % kSections) % kSections;
                alternative.section.u = static_cast<std::uint8_t>(
                    section_of(CodeVariant::anoto, wanted, alternative.cell.x, place.cell.y));
            }
        }
    }
    // The section along y is chosen so that the rolls of the rows do not change.
    const int row =
        code::roll_from(CodeVariant::anoto, place.cell.y, place.section.v, place.cell.x);
    alternative.section.v = static_cast<std::uint8_t>(
        section_of(CodeVariant::anoto, row, place.cell.y, alternative.cell.x));
    return alternative;
}

TEST_F(DeviceTracked, FollowsNoWrongPrediction) {
    Prediction other;
    for (std::uint64_t i = 0; i < 150; ++i) {
        const Shot shot = shot_of(1000 + i);
        const GreyImage image = render(shot);
        const Fix before = fresh(image);
        if (before.status != Status::ok) continue;
        const Prediction right = Prediction::like(before);
        std::array<Prediction, 7> wrong;
        wrong.fill(right);
        wrong[0] = other;
        wrong[1].place = moved(CodeVariant::anoto, right.place, 1, 0);
        wrong[2].place = moved(CodeVariant::anoto, right.place, 0, -2);
        wrong[3].place.section.v = static_cast<std::uint8_t>((right.place.section.v + 5) % 63);
        wrong[4].place.cell.y = (right.place.cell.y + 12345) % kPositionsPerAxis;
        // The prediction is rotated by a quarter turn.
        std::swap(wrong[5].pattern_from_image.du_q24, wrong[5].pattern_from_image.dv_q24);
        wrong[5].pattern_from_image.du_q24.x *= -1;
        wrong[5].pattern_from_image.du_q24.y *= -1;
        // `worst_alternative` compares columns from its argument onwards. The argument is therefore
        // the place of the first column in view, and the prediction is relative to that column.
        const Place first = moved(CodeVariant::anoto, right.place,
                                  (right.pattern_from_image.at_centre_q16.x >> 16) - 10, 0);
        wrong[6].place = worst_alternative(first);
        wrong[6].pattern_from_image.at_centre_q16.x =
            (right.pattern_from_image.at_centre_q16.x & 0xFFFF) + 10 * 65536;
        for (std::size_t n = 0; n < wrong.size(); ++n) {
            const Fix fix = tracked(image, disturbed(wrong[n]));
            EXPECT_TRUE(fix.status != Status::ok || is_right(fix, shot)) << i << ' ' << n;
        }
        other = right;
    }
}

TEST_F(DeviceTracked, SeesNoPatternWhereThereIsNone) {
    const Shot shot = shot_of(5);
    const Fix before = fresh(render(shot));
    ASSERT_EQ(before.status, Status::ok);
    for (std::uint64_t i = 0; i < 100; ++i) {
        for (const Scene scene : kScenes) {
            if (scene == Scene::seam_vertical || scene == Scene::seam_horizontal) continue;
            Shot view = shot;
            view.seed += i;
            const GreyImage image = render_scene(scene, view);
            const Fix fix = tracked(image, disturbed(Prediction::like(before)));
            EXPECT_EQ(fix.status, Status::not_tracked) << name(scene) << ' ' << i;
        }
    }
}

TEST_F(DeviceTracked, TakesPredictionsOfAnyBits) {
    const Shot shot = shot_of(6);
    const GreyImage image = render(shot);
    const Fix before = fresh(image);
    ASSERT_EQ(before.status, Status::ok);
    for (int i = 0; i < 3000; ++i) {
        Prediction prediction = Prediction::like(before);
        std::array<std::uint32_t, sizeof prediction / 4> words;
        std::memcpy(words.data(), &prediction, sizeof words);
        // Each change replaces a word of the prediction with a random word, or inverts one bit of
        // the word. Every fourth trial makes four changes per word on average, so nearly all words
        // change. The other trials make two to four changes in total.
        const int changes = i % 4 == 0 ? static_cast<int>(4 * words.size()) : 1 + i % 4;
        for (int n = 0; n < changes; ++n) {
            const auto word = static_cast<std::size_t>(rng_.below(words.size()));
            const auto bits = rng_.below(65536) << 16 | rng_.below(65536);
            words[word] = n % 2 == 0 ? bits : words[word] ^ std::uint32_t{1} << bits % 32;
        }
        std::memcpy(static_cast<void*>(&prediction), words.data(), sizeof words);
        const Fix fix = tracked(image, prediction);
        EXPECT_TRUE(fix.status != Status::ok || is_right(fix, shot)) << i;
    }
}

TEST_F(DeviceTracked, RefusesFramesThatEndTooSoonOrHaveNoRoom) {
    const Shot shot = shot_of(7);
    const GreyImage image = render(shot);
    const Fix before = fresh(image);
    ASSERT_EQ(before.status, Status::ok);
    const Prediction prediction = Prediction::like(before);
    ASSERT_EQ(locator_.begin(188, 120, prediction), Status::ok);
    for (int v = 0; v < 50; ++v)
        locator_.push_row(image.view().row(v));
    EXPECT_EQ(locator_.finish().status, Status::not_tracked);
    EXPECT_EQ(locator_.begin(63, 64, prediction), Status::image_too_small);
    EXPECT_EQ(locator_.begin(188, 4096, prediction), Status::not_tracked);
    // A frame that begins without a prediction is located without tracking, regardless of the last
    // prediction.
    const Prediction wrong = moved(prediction, CodeVariant::anoto, {50 << 16, 0}, 0, {});
    EXPECT_EQ(tracked(image, wrong).status, Status::not_tracked);
    ASSERT_EQ(locator_.begin(188, 120), Status::ok);
    for (int v = 0; v < 120; ++v)
        locator_.push_row(image.view().row(v));
    EXPECT_EQ(locator_.finish().attempt, Attempt::device);
    DeviceOptions bent;
    bent.lens = FixedLens::from_k(-1e-6);
    locator_.set_options(bent);
    EXPECT_EQ(locator_.begin(188, 120, prediction), Status::not_tracked);
    EXPECT_EQ(locator_.finish().status, Status::not_tracked);
}

}  // namespace
}  // namespace dotpose::core_test::device_tracked_test
