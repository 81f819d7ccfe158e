#include <complex>

#include <gtest/gtest.h>

#include "helpers.hpp"

namespace dotpose::simulate_test {
namespace {

constexpr double kCentreU = 93.5;
constexpr double kCentreV = 59.5;
constexpr double kMm = 0.046;

Vec2 pixel(const CameraModel& camera, const CameraPose& pose, Vec2 offset_mm) {
    return Projection(camera, pose).pixel_from_offset(offset_mm);
}

void expect_near(Vec2 a, Vec2 b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
}

TEST(Projection, ThePosePointLiesUnderTheImageCentre) {
    for (const double degrees : {0.0, 37.0, -160.0}) {
        CameraPose pose;
        pose.theta_rad = radians(degrees);
        pose.tilt_x_rad = 0.05;
        pose.tilt_y_rad = -0.04;
        expect_near(pixel({}, pose, {0, 0}), {kCentreU, kCentreV}, 1e-12);
    }
}

TEST(Projection, AtZeroDegreesImageAndPatternAxesAgree) {
    expect_near(pixel({}, {}, {20 * kMm, -7 * kMm}), {kCentreU + 20, kCentreV - 7}, 1e-9);
}

TEST(Projection, AtNinetyDegreesTheImageXAxisPointsDownThePage) {
    CameraPose pose;
    pose.theta_rad = radians(90);
    // The camera is turned by 90 degrees. A step of 20 px along image x is a step down on the page,
    // and a step along image y is a step to the left.
    expect_near(pixel({}, pose, {0, 20 * kMm}), {kCentreU + 20, kCentreV}, 1e-9);
    expect_near(pixel({}, pose, {-7 * kMm, 0}), {kCentreU, kCentreV + 7}, 1e-9);
}

TEST(Projection, AtThirtySevenDegreesTheFormulaOfTheHeaderHolds) {
    CameraPose pose;
    pose.theta_rad = radians(37);
    const double c = 0.798635510047292846;  // cosine and sine of 37 degrees, from a table
    const double s = 0.601815023152048280;
    const Vec2 offset{kMm * (c * 30 - s * -12), kMm * (s * 30 + c * -12)};
    expect_near(pixel({}, pose, offset), {kCentreU + 30, kCentreV - 12}, 1e-9);
}

TEST(Projection, ARollingShutterReadsEachRowAtItsOwnTime) {
    CameraModel camera;
    camera.k = -1e-5;
    CameraPose pose;
    pose.theta_rad = 0.4;
    pose.tilt_x_rad = 0.05;
    CameraModel rolling = camera;
    rolling.readout_px = {24, -9};
    const auto undistorted = [&](Vec2 at) {
        const Vec2 from_centre{at.x - kCentreU, at.y - kCentreV};
        const double square = from_centre.x * from_centre.x + from_centre.y * from_centre.y;
        const double scale = 1 / (1 + camera.k * square);
        return Vec2{scale * from_centre.x, scale * from_centre.y};
    };
    for (const Vec2 offset_mm : {Vec2{0, 0}, Vec2{1.7, -2.1}, Vec2{-3, 1.2}}) {
        const Vec2 still = undistorted(pixel(camera, pose, offset_mm));
        const Vec2 moved = pixel(rolling, pose, offset_mm);
        const double time = (moved.y - kCentreV) / 120;
        expect_near(undistorted(moved), {still.x + 24 * time, still.y - 9 * time}, 1e-9);
        expect_near(Projection(rolling, pose).offset_from_pixel(moved), offset_mm, 1e-9);
    }
}

TEST(Projection, ATurningSceneIsSeenInEachRowAtTheAngleOfItsTime) {
    CameraModel rolling;
    rolling.readout_px = {10, 6};
    for (const double turn_deg : {-55.0, 4.0, 40.0}) {
        rolling.readout_turn_rad = radians(turn_deg);
        for (const Vec2 still_px : {Vec2{0, 0}, Vec2{30, -41}, Vec2{-60, 17}}) {
            const Vec2 offset_mm{kMm * still_px.x, kMm * still_px.y};
            const Vec2 seen = pixel(rolling, {}, offset_mm);
            const double time = (seen.y - kCentreV) / 120;
            // The scene turns about a fixed point c in the image, at which the motion and the
            // effect of the rotation cancel. In complex numbers, 10 + 6 i + i turn c = 0.
            const std::complex<double> i(0, 1);
            const std::complex<double> c = std::complex(10.0, 6.0) * i / radians(turn_deg);
            const std::complex<double> expected = c + (std::complex(still_px.x, still_px.y) - c) *
                                                          std::polar(1.0, radians(turn_deg) * time);
            expect_near(seen, {kCentreU + expected.real(), kCentreV + expected.imag()}, 1e-6);
            expect_near(Projection(rolling, {}).offset_from_pixel(seen), offset_mm, 1e-6);
        }
    }
}

TEST(Projection, ADotToTheRightOfAClockwiseTurnIsSeenLower) {
    // At row v, the scene has turned by v / 120 rad. The point (60, 0) appears in the row v = 60
    // sin(v / 120), which has the solution v = 0. The point (60, 10) appears in the row v = 60
    // sin(v / 120) + 10 cos(v / 120), which has the solution v = 19.6450.
    CameraModel rolling;
    rolling.readout_turn_rad = 1;
    expect_near(pixel(rolling, {}, {60 * kMm, 0}), {kCentreU + 60, kCentreV}, 1e-9);
    EXPECT_NEAR(pixel(rolling, {}, {60 * kMm, 10 * kMm}).y - kCentreV, 19.6450, 5e-4);
}

TEST(Projection, TurningAndBackIsInverseOverTheWholeImage) {
    CameraModel rolling;
    rolling.readout_turn_rad = radians(60);
    rolling.k = -1e-5;
    const Projection projection(rolling, {});
    for (int v = 0; v < 120; v += 17) {
        for (int u = 0; u < 188; u += 17) {
            const Vec2 there{1.0 * u, 1.0 * v};
            expect_near(projection.pixel_from_offset(projection.offset_from_pixel(there)), there,
                        1e-5);
        }
    }
}

TEST(Projection, TiltAboutXMovesTheLowerPaperAway) {
    CameraPose pose;
    pose.tilt_x_rad = radians(3);
    // By similar triangles, a point that is t mm down the paper is t cos(3 degrees) below the
    // optical axis, at a distance of 16 mm + t sin(3 degrees).
    const double t = 2;
    const double below = t * std::cos(radians(3));
    const double depth = 16 + t * std::sin(radians(3));
    expect_near(pixel({}, pose, {0, t}), {kCentreU, kCentreV + 16 / kMm * below / depth}, 1e-9);
    EXPECT_LT(16 / depth, 1);
}

TEST(Projection, TiltAboutYBringsTheRightPaperCloser) {
    CameraPose pose;
    pose.tilt_y_rad = radians(3);
    const double s = 3;
    const double right = s * std::cos(radians(3));
    const double depth = 16 - s * std::sin(radians(3));
    expect_near(pixel({}, pose, {s, 0}), {kCentreU + 16 / kMm * right / depth, kCentreV}, 1e-9);
}

TEST(Projection, WithAnyTiltThetaIsTheDirectionOfTheImageXAxisAtTheCentre) {
    for (const double degrees : {0.0, 25.0, -118.0}) {
        CameraPose pose;
        pose.theta_rad = radians(degrees);
        pose.tilt_x_rad = radians(20);
        pose.tilt_y_rad = radians(-15);
        const Projection projection({}, pose);
        const Vec2 ahead = projection.offset_from_pixel({kCentreU + 1e-4, kCentreV});
        EXPECT_NEAR(std::atan2(ahead.y, ahead.x), pose.theta_rad, 1e-6);
    }
}

TEST(Projection, DistortionIsTheInverseOfThePapersEquation2) {
    CameraModel camera;
    camera.k = -8e-6;
    const Vec2 distorted = pixel(camera, {}, {80 * kMm, -40 * kMm});
    const double du = distorted.x - kCentreU;
    const double dv = distorted.y - kCentreV;
    const double scale = 1 / (1 + camera.k * (du * du + dv * dv));
    EXPECT_NEAR(du * scale, 80, 1e-9);
    EXPECT_NEAR(dv * scale, -40, 1e-9);
    EXPECT_LT(du, 80) << "k below 0 is barrel distortion";
}

TEST(Projection, BothWaysAreInverse) {
    for (const double k : {0.0, -2e-5, 1e-5}) {
        CameraModel camera;
        camera.k = k;
        CameraPose pose;
        pose.theta_rad = 2.5;
        pose.tilt_x_rad = 0.05;
        pose.tilt_y_rad = 0.03;
        const Projection projection(camera, pose);
        for (int v = 0; v < 120; v += 17) {
            for (int u = 0; u < 188; u += 17) {
                const Vec2 there{1.0 * u, 1.0 * v};
                const Vec2 back = projection.pixel_from_offset(projection.offset_from_pixel(there));
                expect_near(back, there, 1e-8);
            }
        }
    }
}

TEST(Projection, APointBehindTheCameraIsFarAway) {
    CameraPose pose;
    pose.tilt_x_rad = radians(45);
    EXPECT_GE(pixel({}, pose, {0, -100}).x, 1e9);
}

}  // namespace
}  // namespace dotpose::simulate_test
