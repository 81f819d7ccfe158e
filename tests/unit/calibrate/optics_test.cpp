// Tests optics reports against the values in the paper (section III-A) and the thin lens equations.
#include "dotpose/tools/optics.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dotpose {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsTrue;

TEST(Optics, GivesThePapersNumbers) {
    const OpticsReport report = design_optics(paper_optics());
    EXPECT_NEAR(report.block_diagonal_mm, 5.39, 0.005);
    EXPECT_NEAR(report.field_diagonal_mm, 10.19, 0.005);
    EXPECT_EQ(std::floor(report.fastest_mm_s), 353);
    EXPECT_EQ(std::floor(report.fastest_turn_rpm), 785);
    EXPECT_TRUE(report.block_fits);
    EXPECT_FALSE(report.block_fits_anywhere);
    for (const OpticsAdvice& advice : report.advice)
        EXPECT_FALSE(advice.is_fault) << advice.text;
}

/// Returns the side length of the smallest square field of view that contains a block of dots with
/// the diagonal `diagonal_mm`. The grid is rotated by 45 degrees. (`x_mm`, `y_mm`) is the offset of
/// the image centre from the centre of a block, along the grid axes.
double field_for_block(double diagonal_mm, double spacing_mm, double x_mm, double y_mm) {
    double smallest_mm = HUGE_VAL;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            const double dx_mm = x_mm - i * spacing_mm;
            const double dy_mm = y_mm - j * spacing_mm;
            const double u_mm = std::abs(dx_mm - dy_mm) / std::numbers::sqrt2;
            const double v_mm = std::abs(dx_mm + dy_mm) / std::numbers::sqrt2;
            smallest_mm = std::min(smallest_mm, diagonal_mm + 2 * std::max(u_mm, v_mm));
        }
    }
    return smallest_mm;
}

TEST(Optics, ABlockFitsAnywhereInTheSmallestFieldForEveryPosition) {
    const Optics optics = paper_optics();
    const OpticsReport report = design_optics(optics);
    double largest_mm = 0;
    constexpr int kSteps = 20;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
            largest_mm =
                std::max(largest_mm, field_for_block(report.block_diagonal_mm, optics.spacing_mm,
                                                     optics.spacing_mm * i / kSteps,
                                                     optics.spacing_mm * j / kSteps));
        }
    }
    EXPECT_NEAR(report.block_anywhere_mm, largest_mm, 1e-9);
}

TEST(Optics, IsThatOfAThinLens) {
    Optics optics;
    optics.width_px = 640;
    optics.height_px = 480;
    optics.pixel_um = 6;
    optics.focal_mm = 10;
    optics.distance_mm = 30;  // the image is 15 mm behind the lens, at half size
    optics.f_number = 4;
    optics.exposure_s = 0.001;
    optics.speed_mm_s = 6;
    optics.turn_rpm = 0;
    const OpticsReport report = design_optics(optics);
    EXPECT_NEAR(report.magnification, 0.5, 1e-12);
    EXPECT_NEAR(report.mm_per_px, 0.012, 1e-12);
    EXPECT_NEAR(report.field_width_mm, 7.68, 1e-9);
    EXPECT_NEAR(report.blur_px, 0.5, 1e-9);
    EXPECT_NEAR(report.longest_exposure_s, 0.002, 1e-9);
    EXPECT_NEAR(report.fastest_mm_s, 12, 1e-9);
    // A point at either end of the depth of field is imaged in front of or behind the sensor. Its
    // blur on the sensor is one pixel (6 µm) wide.
    for (const double end_mm : {report.near_mm, report.far_mm}) {
        const double image_mm = 1 / (1 / optics.focal_mm - 1 / end_mm);
        const double aperture_mm = optics.focal_mm / optics.f_number;
        EXPECT_NEAR(aperture_mm * std::abs(image_mm - 15) / image_mm, 0.006, 1e-9);
    }
}

TEST(Optics, MotionAndExposureAreEachOthersInverse) {
    Optics optics = paper_optics();
    optics.speed_mm_s = 250;
    optics.turn_rpm = 90;
    optics.exposure_s = design_optics(optics).longest_exposure_s;
    EXPECT_NEAR(design_optics(optics).blur_px, 1, 1e-9);
}

TEST(Optics, SaysWhatToChange) {
    Optics optics;
    optics.width_px = 188;
    optics.pixel_um = 24;
    optics.distance_mm = 50;  // one spacing is 3 px in the image
    optics.speed_mm_s = 5000;
    const auto faults = design_optics(optics).advice;
    const auto says = [](const char* words) {
        return Contains(testing::AllOf(Field(&OpticsAdvice::is_fault, IsTrue()),
                                       Field(&OpticsAdvice::text, HasSubstr(words))));
    };
    // At a spacing of 8 px, the magnification is 8 x 0.024 / 0.508 = 0.378. The distance is
    // therefore 5.5 mm (1 + 1 / 0.378) = 20.05 mm, where 5.5 mm is the focal length.
    EXPECT_THAT(faults, says("go closer (20.1 mm)"));
    EXPECT_THAT(faults, says("print larger dots"));

    optics.distance_mm = 10;  // too close: only a few dots are in view
    const auto narrow = design_optics(optics).advice;
    EXPECT_THAT(narrow, says("8 x 8 dots do not fit at every angle"));
    EXPECT_THAT(narrow, says("motion blurs the image"));
}

TEST(Optics, RefusesWhatCannotBe) {
    Optics optics;
    optics.distance_mm = optics.focal_mm;
    EXPECT_THROW(design_optics(optics), BadArgument);
    optics = {};
    optics.exposure_s = 0;
    EXPECT_THROW(design_optics(optics), BadArgument);
    optics = {};
    optics.speed_mm_s = -1;
    EXPECT_THROW(design_optics(optics), BadArgument);
}

}  // namespace
}  // namespace dotpose
