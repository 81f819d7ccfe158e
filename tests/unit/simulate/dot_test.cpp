// Tests the image of one dot: position, area, spread and printing errors.
#include <algorithm>

#include <gtest/gtest.h>

#include "helpers.hpp"

namespace dotpose::simulate_test {
namespace {

// Returns a pose near the dot, at a random position and angle.
CameraPose pose_near_dot(Rng& rng) {
    CameraPose pose;
    pose.cell = kDotCell;
    pose.fraction_x = rng.uniform(-3, 3);
    pose.fraction_y = rng.uniform(-3, 3);
    pose.theta_rad = rng.uniform(-3.14, 3.14);
    return pose;
}

CameraModel camera_with_spacing(double spacing_px) {
    CameraModel camera;
    camera.mm_per_px = kDefaultSpacing_mm / spacing_px;
    camera.width_px = static_cast<int>(12 * spacing_px);
    camera.height_px = static_cast<int>(12 * spacing_px);
    return camera;
}

// Returns the light that reaches each pixel. Samples the disc at 64 x 64 points per pixel, which is
// slow but independent of the renderer.
std::vector<double> sampled(const CameraModel& camera, Vec2 centre, double radius_px,
                            const Imperfections& seen) {
    constexpr int kPoints = 64;
    std::vector<double> levels;
    for (int v = 0; v < camera.height_px; ++v) {
        for (int u = 0; u < camera.width_px; ++u) {
            int inside = 0;
            const bool near = std::hypot(u - centre.x, v - centre.y) < radius_px + 1;
            for (int i = 0; near && i < kPoints * kPoints; ++i) {
                const double x = u + (i % kPoints + 0.5) / kPoints - 0.5 - centre.x;
                const double y = v + (i / kPoints + 0.5) / kPoints - 0.5 - centre.y;
                inside += x * x + y * y < radius_px * radius_px ? 1 : 0;
            }
            const double fraction = static_cast<double>(inside) / (kPoints * kPoints);
            levels.push_back(seen.paper_level * (1 - (1 - seen.ink_reflectance) * fraction));
        }
    }
    return levels;
}

TEST(Dot, WithoutBlurEachPixelHasTheAreaThatTheDiscCovers) {
    Rng rng(1);
    for (const double spacing_px : {6.0, 11.04, 30.0}) {
        const CameraModel camera = camera_with_spacing(spacing_px);
        for (int trial = 0; trial < 5; ++trial) {
            const CameraPose pose = pose_near_dot(rng);
            const Vec2 centre =
                Projection(camera, pose).pixel_from_offset(dot_offset_mm(one_dot_page(), pose));
            const std::vector<float> levels = exact_levels(one_dot_page(), camera, pose, {});
            const std::vector<double> expected = sampled(camera, centre, spacing_px / 12, {});
            for (std::size_t i = 0; i < levels.size(); ++i) {
                ASSERT_NEAR(static_cast<double>(levels[i]), expected[i], 0.7) << spacing_px;
            }
            EXPECT_LT(distance(measure(levels, camera.width_px, 200).centroid_px,
                               measure(expected, camera.width_px, 200).centroid_px),
                      0.002)
                << spacing_px;
        }
    }
}

struct CentroidCase {
    double spacing_px;
    double sigma_px;
    Vec2 motion_px;
    double tilt_deg;
    double k_r2;  // k in units of 1 / (half diagonal)^2
};

class Centroid : public testing::TestWithParam<CentroidCase> {};

TEST_P(Centroid, IsWhereTheDotWasPrinted) {
    const CentroidCase& given = GetParam();
    CameraModel camera = camera_with_spacing(given.spacing_px);
    camera.k = given.k_r2 / (2 * 36 * given.spacing_px * given.spacing_px);
    Imperfections seen;
    seen.blur_sigma_px = given.sigma_px;
    seen.motion_px = given.motion_px;
    Rng rng(2);
    double worst_px = 0;
    for (int trial = 0; trial < 100; ++trial) {
        CameraPose pose = pose_near_dot(rng);
        pose.tilt_x_rad = radians(given.tilt_deg);
        pose.tilt_y_rad = radians(-given.tilt_deg);
        const Vec2 centre =
            Projection(camera, pose).pixel_from_offset(dot_offset_mm(one_dot_page(), pose));
        const auto levels = exact_levels(one_dot_page(), camera, pose, seen);
        worst_px =
            std::max(worst_px, distance(measure(levels, camera.width_px, 200).centroid_px, centre));
    }
    RecordProperty("worst_px", std::to_string(worst_px));
    EXPECT_LT(worst_px, 0.003);
}

INSTANTIATE_TEST_SUITE_P(
    Simulate, Centroid,
    testing::Values(CentroidCase{11.04, 0.4, {}, 0, 0}, CentroidCase{11.04, 0.7, {0.5, 0}, 0, 0},
                    CentroidCase{11.04, 1.1, {-1.2, 1.6}, 0, 0}, CentroidCase{11.04, 0.5, {}, 3, 0},
                    CentroidCase{11.04, 0.5, {}, 0, -0.2},
                    CentroidCase{11.04, 0.5, {0.3, 0.3}, 3, 0.1}, CentroidCase{6, 0.5, {}, 0, 0},
                    CentroidCase{20, 0.5, {}, 0, 0}, CentroidCase{30, 0.5, {}, 3, -0.1},
                    CentroidCase{60, 0.5, {}, 3, 0}));

TEST(Dot, InkMassIsTheDotsAreaWhateverBlursIt) {
    Rng rng(3);
    const CameraModel camera;
    const double radius_px = kDefaultSpacing_mm / 12 / camera.mm_per_px;
    const double area_px2 = std::numbers::pi * radius_px * radius_px;
    for (const double sigma_px : {0.0, 0.4, 1.1}) {
        for (const Vec2 motion_px : {Vec2{0, 0}, Vec2{2, 0}, Vec2{-0.9, 0.7}}) {
            Imperfections seen;
            seen.blur_sigma_px = sigma_px;
            seen.motion_px = motion_px;
            const auto levels = exact_levels(one_dot_page(), camera, pose_near_dot(rng), seen);
            EXPECT_NEAR(measure(levels, camera.width_px, 200).mass, 0.85 * area_px2,
                        0.001 * area_px2);
        }
    }
}

// The light removed by several dots is the sum of the light removed by each dot alone. Light is
// additive, so this is true even if blurred dots overlap or are cut off by the image border.
TEST(Dot, ManyTakeAwayTheSumOfEach) {
    Rng rng(6);
    CameraModel camera;
    camera.width_px = 61;
    camera.height_px = 43;
    Imperfections seen;
    seen.blur_sigma_px = 0.9;
    seen.motion_px = {1.1, -0.8};
    seen.vignetting = 0.3;
    const simulate::View view(camera, {}, seen);
    const std::vector<float> paper = expose({}, view, Page{}, seen);
    std::vector<double> sum(paper.begin(), paper.end());
    simulate::Ink all;
    for (int i = 0; i < 40; ++i) {
        // The columns are 3 px apart, so the dots do not overlap. The rows are random.
        const double u = 3 * (i % 23) - 2.5;
        const double v = i < 23 ? rng.uniform(-2, 20) : rng.uniform(23, 45);
        simulate::Ink one;
        one.ellipses.push_back({{u, v}, 0.9, 0.3, 1.2, rng.uniform(0.1, 0.5)});
        const std::vector<float> levels = expose(one, view, Page{}, seen);
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += static_cast<double>(levels[k]) - static_cast<double>(paper[k]);
        all.ellipses.insert(all.ellipses.begin() + i / 2, one.ellipses.front());
    }
    const std::vector<float> levels = expose(all, view, Page{}, seen);
    for (std::size_t k = 0; k < sum.size(); ++k)
        ASSERT_NEAR(static_cast<double>(levels[k]), sum[k], 2e-3) << k;
}

TEST(Dot, BlurAndMotionWidenItAsTheyShould) {
    const CameraModel camera;
    CameraPose pose;
    pose.cell = kDotCell;
    const double radius_px = kDefaultSpacing_mm / 12 / camera.mm_per_px;
    Imperfections seen;
    seen.blur_sigma_px = 0.8;
    seen.motion_px = {1.8, 0};
    const Darkness dot = measure(exact_levels(one_dot_page(), camera, pose, seen), 188, 200);
    // The variance of a dot's image is the sum of the variances of the disc (r^2 / 4), the lens
    // (sigma^2), the pixel (1/12) and the motion (length^2 / 12).
    const double still = radius_px * radius_px / 4 + 0.64 + 1.0 / 12;
    EXPECT_NEAR(dot.variance_v, still, 0.005);
    EXPECT_NEAR(dot.variance_u, still + 1.8 * 1.8 / 12, 0.01);
}

// The printing error of a dot is fixed on the paper. A camera must therefore measure the same error
// from every pose.
TEST(Dot, PrintingErrorsBelongToThePage) {
    Imperfections seen;
    seen.blur_sigma_px = 0.5;
    seen.jitter_mm = 0.02;
    seen.ink_variation = 0.08;
    Rng rng(4);
    const CameraModel camera;
    Vec2 first_error{};
    double first_mass = 0;
    for (int trial = 0; trial < 4; ++trial) {
        const CameraPose pose = pose_near_dot(rng);
        const Darkness dot =
            measure(exact_levels(one_dot_page(), camera, pose, seen), camera.width_px, 200);
        const Vec2 found = Projection(camera, pose).offset_from_pixel(dot.centroid_px);
        const Vec2 nominal = dot_offset_mm(one_dot_page(), pose);
        const Vec2 error{found.x - nominal.x, found.y - nominal.y};
        if (trial == 0) {
            first_error = error;
            first_mass = dot.mass;
            EXPECT_GT(std::hypot(error.x, error.y), 0.002);
        }
        EXPECT_NEAR(error.x, first_error.x, 2e-4);
        EXPECT_NEAR(error.y, first_error.y, 2e-4);
        EXPECT_NEAR(dot.mass, first_mass, 0.01);
    }
    Page other = one_dot_page();
    other.seed = 2;
    CameraPose pose;
    pose.cell = kDotCell;
    EXPECT_NE(exact_levels(other, camera, pose, seen),
              exact_levels(one_dot_page(), camera, pose, seen));
}

TEST(Dot, IsAsExactAtTheFarEndOfThePlane) {
    constexpr Cell kFar{kPositionsPerAxis - 20, kPositionsPerAxis - 30};
    Page page;
    page.origin = kFar;
    page.columns = 1;
    page.rows = 1;
    CameraPose pose;
    pose.cell = kFar;
    pose.fraction_x = 0.123456789;
    Imperfections seen;
    seen.blur_sigma_px = 0.5;
    const Symbol symbol = symbol_at(page.pattern.code, kFar, page.pattern.section);
    const double px_per_mm = 1 / CameraModel{}.mm_per_px;
    const Vec2 expected{93.5 + (dx(symbol) / 6.0 - 0.123456789) * kDefaultSpacing_mm * px_per_mm,
                        59.5 + dy(symbol) / 6.0 * kDefaultSpacing_mm * px_per_mm};
    const Darkness dot = measure(exact_levels(page, {}, pose, seen), 188, 200);
    EXPECT_LT(distance(dot.centroid_px, expected), 0.003);
}

TEST(Dot, LiesWhereAStretchedPageHasIt) {
    Page page = one_dot_page();
    page.print_scale = {1.04, 0.97};
    CameraPose pose;
    pose.cell = {kDotCell.x - 4, kDotCell.y + 3};
    pose.fraction_x = 0.25;
    pose.theta_rad = 0.7;
    Imperfections seen;
    seen.blur_sigma_px = 0.5;
    const Vec2 meant = dot_offset_mm(page, pose);
    const Vec2 expected = Projection({}, pose).pixel_from_offset({1.04 * meant.x, 0.97 * meant.y});
    const Darkness dot = measure(exact_levels(page, {}, pose, seen), 188, 200);
    EXPECT_LT(distance(dot.centroid_px, expected), 0.003);
    page.print_scale.y = 0;
    EXPECT_THROW(render(page, {}, pose, seen, 1), BadArgument);
}

TEST(Dot, MissingAndJitterHaveTheirStatistics) {
    CameraModel camera;
    camera.width_px = 1000;
    camera.height_px = 1000;
    CameraPose pose;
    pose.cell = {5000, 6000};
    Imperfections seen;
    const auto dots = [&] {
        const simulate::View view(camera, pose, seen);
        simulate::Ink ink;
        add_dots(ink, view, Page{}, seen, [](Cell) { return Vec2{}; });
        return ink.ellipses;
    };
    const auto perfect = dots();
    seen.jitter_mm = 0.02;
    const auto jittered = dots();
    ASSERT_NEAR(static_cast<double>(perfect.size()), static_cast<double>(jittered.size()), 20);
    double square = 0;
    int counted = 0;
    for (const auto& dot : jittered) {
        // Without displacement, all dots are on the intersections, 11.04 px apart.
        const double step_px = kDefaultSpacing_mm / camera.mm_per_px;
        const double error = std::remainder(dot.centre_px.x - 499.5, step_px);
        square += error * error;
        ++counted;
    }
    EXPECT_NEAR(std::sqrt(square / counted) * camera.mm_per_px, 0.02, 0.001);

    seen.missing = 0.03;
    const double kept = static_cast<double>(dots().size()) / static_cast<double>(jittered.size());
    EXPECT_NEAR(kept, 0.97, 0.008);
}

TEST(Dots, LieWhereThePageShiftsThem) {
    Page page = one_dot_page();
    CameraModel camera;
    CameraPose pose;
    pose.cell = kDotCell;
    pose.theta_rad = radians(90);  // +x of the pattern is up in the image, +y to the right
    const auto centre_px = [&] {
        const simulate::View view(camera, pose, {});
        simulate::Ink ink;
        add_dots(ink, view, page, {}, [](Cell) { return Vec2{}; });
        return ink.ellipses.at(0).centre_px;
    };
    EXPECT_NEAR(centre_px().x, (camera.width_px - 1) / 2.0, 1e-9);
    EXPECT_NEAR(centre_px().y, (camera.height_px - 1) / 2.0, 1e-9);
    Vec2 asked;
    page.shift_mm = [&](Vec2 place_grid) {
        asked = place_grid;
        return Vec2{2 * camera.mm_per_px, -3 * camera.mm_per_px};
    };
    EXPECT_NEAR(centre_px().x, (camera.width_px - 1) / 2.0 - 3, 1e-9);
    EXPECT_NEAR(centre_px().y, (camera.height_px - 1) / 2.0 - 2, 1e-9);
    EXPECT_EQ(asked.x, kDotCell.x);
    EXPECT_EQ(asked.y, kDotCell.y);
}

}  // namespace
}  // namespace dotpose::simulate_test
