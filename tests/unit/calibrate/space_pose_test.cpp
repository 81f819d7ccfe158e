// Tests poses in space. The expected pixel positions come from a projection in this file: a pinhole
// camera with the division model (paper, equation 2).
#include "dotpose/tools/space_pose.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "calibrate/space_fit.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

using std::numbers::pi;

constexpr double kDegree_rad = pi / 180;

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;  // rows

Matrix3 product(const Matrix3& a, const Matrix3& b) {
    Matrix3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k)
                result[i][j] += a[i][k] * b[k][j];
        }
    }
    return result;
}

Vector3 product(const Matrix3& a, const Vector3& v) {
    Vector3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i] += a[i][j] * v[j];
    }
    return result;
}

Matrix3 transposed(const Matrix3& a) {
    Matrix3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = a[j][i];
    }
    return result;
}

Matrix3 about_z(double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

Matrix3 about_y(double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}};
}

/// Returns the rotation from the camera to the paper according to the definition of CameraLean: a
/// turn, followed by a lean. If a camera leans towards +x, its optical axis points towards -x.
Matrix3 rotation_of(const CameraLean& lean) {
    return product(product(about_z(lean.azimuth_rad),
                           product(about_y(-lean.tilt_rad), about_z(-lean.azimuth_rad))),
                   about_z(lean.turn_rad));
}

Matrix3 rotation_of(const Quaternion& q) {
    return {{{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z),
              2 * (q.x * q.z + q.w * q.y)},
             {2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z),
              2 * (q.y * q.z - q.w * q.x)},
             {2 * (q.x * q.z - q.w * q.y), 2 * (q.y * q.z + q.w * q.x),
              1 - 2 * (q.x * q.x + q.y * q.y)}}};
}

double angle_between(const Matrix3& a, const Matrix3& b) {
    const Matrix3 turn = product(transposed(a), b);
    const double sine =
        std::hypot(turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1]) / 2;
    return std::atan2(sine, (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2);
}

struct View {
    double focal_px = 800;
    Matrix3 rotation{};  // camera to paper
    Vector3 position_mm{};

    /// Returns the undistorted image position of a point on the paper, in px from the optical axis.
    std::array<double, 2> straight(double x_mm, double y_mm) const {
        const Vector3 seen =
            product(transposed(rotation),
                    Vector3{x_mm - position_mm[0], y_mm - position_mm[1], -position_mm[2]});
        return {focal_px * seen[0] / seen[2], focal_px * seen[1] / seen[2]};
    }
    /// Returns the image position to which a lens with the distortion k maps a point on the paper,
    /// in px from the optical axis.
    std::array<double, 2> distorted(double x_mm, double y_mm, double k) const {
        const auto [a, b] = straight(x_mm, y_mm);
        // Solves equation 2, r_u = r_d / (1 + k r_d^2), by bisection.
        const double wanted = std::hypot(a, b);
        double low = 0;
        double high = 2 * wanted;
        for (int i = 0; i < 100; ++i) {
            const double r = (low + high) / 2;
            (r / (1 + k * r * r) < wanted ? low : high) = r;
        }
        return {a * low / wanted, b * low / wanted};
    }
};

/// Returns the view of a camera that looks at the origin of the paper.
View view_of(const CameraLean& lean, double distance_mm, double focal_px) {
    View view;
    view.focal_px = focal_px;
    view.rotation = rotation_of(lean);
    for (std::size_t i = 0; i < 3; ++i)
        view.position_mm[i] = -distance_mm * view.rotation[i][2];
    return view;
}

/// Returns a square of dots around the origin, with Gaussian errors on the paper (`print_mm`) and
/// in the image (`centre_px`).
std::vector<calibrate::SpaceDot> dots_of(const View& view, int per_side, double spacing_mm,
                                         double print_mm, double centre_px, Rng& rng) {
    constexpr std::array<std::array<int, 2>, 4> kSteps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    std::vector<calibrate::SpaceDot> dots;
    for (int j = 0; j < per_side; ++j) {
        for (int i = 0; i < per_side; ++i) {
            const double x = (i - (per_side - 1) / 2.0) * spacing_mm;
            const double y = (j - (per_side - 1) / 2.0) * spacing_mm;
            const auto [right, down] = kSteps[rng.below(4)];
            const auto [u, v] = view.straight(x + right * spacing_mm / 6 + print_mm * rng.normal(),
                                              y + down * spacing_mm / 6 + print_mm * rng.normal());
            calibrate::SpaceDot dot;
            dot.pixel = {u + centre_px * rng.normal(), v + centre_px * rng.normal()};
            dot.intersection_mm = {x, y};
            dot.direction_mm = {right * spacing_mm, down * spacing_mm};
            dots.push_back(dot);
        }
    }
    return dots;
}

Matrix3 rotation_of(const calibrate::SpaceState& state) {
    Matrix3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = state.rotation(Eigen::Index(i), Eigen::Index(j));
    }
    return result;
}

TEST(SpaceFit, IsExactForAllTurnsTiltsAndAzimuths) {
    Rng rng(1);
    for (int tilt = 0; tilt <= 60; tilt += 10) {
        for (int azimuth = -180; azimuth < 180; azimuth += 45) {
            for (int turn = -170; turn <= 180; turn += 50) {
                const CameraLean lean{tilt * kDegree_rad, azimuth * kDegree_rad,
                                      turn * kDegree_rad};
                const View view = view_of(lean, 25, 800);
                const auto fit =
                    calibrate::fit_space(dots_of(view, 12, 0.5, 0, 0, rng), {800, 800});
                ASSERT_TRUE(fit) << tilt << ' ' << azimuth << ' ' << turn;
                EXPECT_LT(angle_between(view.rotation, rotation_of(fit->state)), 1e-7)
                    << tilt << ' ' << azimuth << ' ' << turn;
                for (std::size_t i = 0; i < 3; ++i) {
                    EXPECT_NEAR(fit->state.position_mm[Eigen::Index(i)], view.position_mm[i], 1e-5)
                        << tilt << ' ' << azimuth << ' ' << turn;
                }
                EXPECT_NEAR(fit->state.displacement, 1.0 / 6, 1e-7);
            }
        }
    }
}

TEST(SpaceFit, HasTrueCovariancesForErrorsOfPrintAndImage) {
    struct Noise {
        double print_mm;
        double centre_px;
    };
    for (const Noise noise : {Noise{0.01, 0}, Noise{0, 0.1}, Noise{0.01, 0.1}}) {
        constexpr int kFits = 300;
        Rng rng(2);
        Eigen::Matrix<double, 6, 1> normalised = Eigen::Matrix<double, 6, 1>::Zero();
        for (int n = 0; n < kFits; ++n) {
            const CameraLean lean{rng.uniform(0, 45) * kDegree_rad, rng.uniform(-pi, pi),
                                  rng.uniform(-pi, pi)};
            const View view = view_of(lean, 30, 600);
            const auto fit = calibrate::fit_space(
                dots_of(view, 30, 0.5, noise.print_mm, noise.centre_px, rng), {600, 600});
            ASSERT_TRUE(fit);
            // The orientation error is a small rotation. The antisymmetric part of its matrix is
            // the rotation vector, in the camera frame.
            const Matrix3 turn = product(transposed(rotation_of(fit->state)), view.rotation);
            const std::array error = {view.position_mm[0] - fit->state.position_mm.x(),
                                      view.position_mm[1] - fit->state.position_mm.y(),
                                      view.position_mm[2] - fit->state.position_mm.z(),
                                      (turn[2][1] - turn[1][2]) / 2,
                                      (turn[0][2] - turn[2][0]) / 2,
                                      (turn[1][0] - turn[0][1]) / 2};
            for (Eigen::Index i = 0; i < 6; ++i) {
                normalised[i] += error[static_cast<std::size_t>(i)] *
                                 error[static_cast<std::size_t>(i)] / fit->covariance(i, i) / kFits;
            }
        }
        // The standard deviation of the mean is sqrt(2 / 300) = 0.08.
        for (Eigen::Index i = 0; i < 6; ++i)
            EXPECT_NEAR(normalised[i], 1, 0.25) << noise.print_mm << ' ' << i;
    }
}

TEST(SpaceFit, ReportsTheMirroredTiltOfANarrowView) {
    // The view contains 15 x 15 dots and is only 1 degree wide, so the effect of perspective is
    // smaller than the noise.
    const CameraLean lean{10 * kDegree_rad, 0.5, 1};
    const CameraLean mirrored{10 * kDegree_rad, 0.5 - pi, 1};
    int ambiguous = 0;
    constexpr int kFits = 50;
    Rng rng(3);
    for (int n = 0; n < kFits; ++n) {
        const View view = view_of(lean, 400, 8000);
        const auto fit = calibrate::fit_space(dots_of(view, 15, 0.5, 0, 0.5, rng), {8000, 8000});
        ASSERT_TRUE(fit && fit->second) << n;
        ambiguous += fit->second_odds_log2 > SpacePose::kMaxOdds_log2;
        EXPECT_LE(fit->second_odds_log2, 0);
        // One of the two reported poses must be the true pose, and the other must be its mirror
        // image.
        const double first = angle_between(view.rotation, rotation_of(fit->state));
        const double second = angle_between(view.rotation, rotation_of(*fit->second));
        EXPECT_LT(std::min(first, second), 5 * kDegree_rad) << n;
        const auto& wrong = first < second ? *fit->second : fit->state;
        EXPECT_LT(angle_between(rotation_of(mirrored), rotation_of(wrong)), 5 * kDegree_rad) << n;
    }
    EXPECT_EQ(ambiguous, kFits);
}

TEST(SpaceFit, ExcludesTheMirroredTiltOfAWideView) {
    Rng rng(4);
    for (int n = 0; n < 50; ++n) {
        const CameraLean lean{rng.uniform(0, 45) * kDegree_rad, rng.uniform(-pi, pi), 0};
        const View view = view_of(lean, 30, 600);
        const auto fit = calibrate::fit_space(dots_of(view, 20, 0.5, 0.01, 0, rng), {600, 600});
        ASSERT_TRUE(fit);
        EXPECT_LT(angle_between(view.rotation, rotation_of(fit->state)), 1 * kDegree_rad);
        EXPECT_TRUE(!fit->second || fit->second_odds_log2 < SpacePose::kMaxOdds_log2);
    }
}

TEST(SpaceFit, IgnoresMisreadDots) {
    Rng rng(5);
    const View view = view_of({0.4, 1, 2}, 30, 600);
    auto dots = dots_of(view, 30, 0.5, 0.005, 0, rng);
    const std::size_t count = dots.size();
    for (std::size_t i = 0; i < count; i += 20)
        dots[i].direction_mm = -dots[i].direction_mm;
    const auto fit = calibrate::fit_space(dots, {600, 600});
    ASSERT_TRUE(fit);
    EXPECT_LE(fit->used.size(), count * 95 / 100);
    EXPECT_GE(fit->used.size(), count * 94 / 100);
    EXPECT_LT(angle_between(view.rotation, rotation_of(fit->state)), 0.1 * kDegree_rad);
}

TEST(SpaceFit, RefusesDotsThatDetermineNoPose) {
    Rng rng(6);
    auto dots = dots_of(view_of({}, 30, 600), 10, 0.5, 0, 0, rng);
    for (calibrate::SpaceDot& dot : dots)
        dot.pixel = {0, 0};
    EXPECT_FALSE(calibrate::fit_space(dots, {600, 600}));
}

TEST(CameraLean, IsTurnThenLean) {
    for (int tilt = 0; tilt <= 170; tilt += 17) {
        for (int azimuth = -170; azimuth <= 180; azimuth += 35) {
            for (int turn = -170; turn <= 180; turn += 50) {
                const CameraLean wanted{tilt * kDegree_rad, azimuth * kDegree_rad,
                                        turn * kDegree_rad};
                // The quaternion is the product of two rotations. The first factor rotates about an
                // axis in the paper, perpendicular to the azimuth. The second factor rotates about
                // the optical axis.
                const double sine = std::sin(wanted.tilt_rad / 2);
                const std::array lean = {std::cos(wanted.tilt_rad / 2),
                                         sine * std::sin(wanted.azimuth_rad),
                                         -sine * std::cos(wanted.azimuth_rad)};
                const double c = std::cos(wanted.turn_rad / 2);
                const double s = std::sin(wanted.turn_rad / 2);
                const Quaternion q{lean[0] * c, lean[1] * c + lean[2] * s,
                                   lean[2] * c - lean[1] * s, lean[0] * s};
                ASSERT_LT(angle_between(rotation_of(q), rotation_of(wanted)), 1e-9);
                const CameraLean found = lean_of(q);
                EXPECT_NEAR(found.tilt_rad, wanted.tilt_rad, 1e-9);
                EXPECT_NEAR(std::remainder(found.turn_rad - wanted.turn_rad, 2 * pi), 0, 1e-9);
                EXPECT_LE(std::abs(found.turn_rad), pi);
                if (tilt == 0) continue;
                EXPECT_NEAR(std::remainder(found.azimuth_rad - wanted.azimuth_rad, 2 * pi), 0,
                            1e-9);
            }
        }
    }
}

Camera camera_of(const CameraModel& model) {
    Camera camera;
    camera.width_px = model.width_px;
    camera.height_px = model.height_px;
    camera.k_per_px2 = model.k;
    camera.centre_px = {(model.width_px - 1) / 2.0, (model.height_px - 1) / 2.0};
    camera.focal_px = model.working_distance_mm / model.mm_per_px;
    return camera;
}

std::optional<SpacePose> located(const Shot& shot, const Camera& camera) {
    DeviceOptions options;
    use_camera(camera, camera.width_px, camera.height_px, options);
    options.show_stages = true;
    Locator locator(options);
    const GreyImage image = render(shot);
    const Fix fix = locator.locate(image.view());
    return space_pose(fix, camera, image.view(), locator.trace());
}

Shot tilted_shot(int index, double tilt_x_deg, double tilt_y_deg) {
    Setup setup;
    setup.camera.width_px = 320;
    setup.camera.height_px = 240;
    setup.camera.k = -2e-6;
    setup.camera.working_distance_mm = 25;
    setup.seed = 45;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    shot.pose.tilt_x_rad = tilt_x_deg * kDegree_rad;
    shot.pose.tilt_y_rad = tilt_y_deg * kDegree_rad;
    return shot;
}

TEST(SpacePose, ProjectsThePatternToThePixelsOfTheFrame) {
    int index = 0;
    for (const double tilt_x : {-25.0, 0.0, 12.0}) {
        for (const double tilt_y : {-12.0, 0.0, 25.0}) {
            const Shot shot = tilted_shot(index++, tilt_x, tilt_y);
            const Camera camera = camera_of(shot.camera);
            const auto pose = located(shot, camera);
            ASSERT_TRUE(pose) << tilt_x << ' ' << tilt_y;
            EXPECT_FALSE(pose->is_ambiguous());
            EXPECT_LT(pose->camera.z_mm, 0);
            View view;
            view.focal_px = *camera.focal_px;
            view.rotation = rotation_of(pose->camera.rotation);
            view.position_mm = {pose->camera.x_mm - x_grid(shot.pose) * kDefaultSpacing_mm,
                                pose->camera.y_mm - y_grid(shot.pose) * kDefaultSpacing_mm,
                                pose->camera.z_mm};
            const Projection truth(shot.camera, shot.pose);
            for (const double x_mm : {-5.0, 0.5, 4.0}) {
                for (const double y_mm : {-3.5, 0.5, 3.0}) {
                    const auto [u, v] = view.distorted(x_mm, y_mm, shot.camera.k);
                    const Vec2 pixel = truth.pixel_from_offset({x_mm, y_mm});
                    EXPECT_NEAR(camera.centre_px.u + u, pixel.x, 0.1) << tilt_x << ' ' << tilt_y;
                    EXPECT_NEAR(camera.centre_px.v + v, pixel.y, 0.1) << tilt_x << ' ' << tilt_y;
                }
            }
        }
    }
}

TEST(SpacePose, OfAStraightCameraIsItsPlaneAndDistance) {
    const Shot shot = tilted_shot(20, 0, 0);
    const auto pose = located(shot, camera_of(shot.camera));
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->camera.z_mm, -25, 0.01);
    EXPECT_NEAR(pose->camera.x_mm, x_grid(shot.pose) * kDefaultSpacing_mm, 0.05);
    EXPECT_NEAR(pose->camera.y_mm, y_grid(shot.pose) * kDefaultSpacing_mm, 0.05);
    const CameraLean lean = lean_of(pose->camera.rotation);
    EXPECT_LT(lean.tilt_rad, 0.1 * kDegree_rad);
    EXPECT_NEAR(std::remainder(lean.turn_rad - shot.pose.theta_rad, 2 * pi), 0, 0.002);
}

TEST(SpacePose, LeansToTheSideOnWhichThePaperIsNear) {
    // The nearest part of the paper is at the top of the image, and the image x axis is the x axis
    // of the paper. The camera therefore leans towards -y, and its optical axis points towards +y.
    Shot shot = tilted_shot(21, 20, 0);
    shot.pose.theta_rad = 0;
    const auto pose = located(shot, camera_of(shot.camera));
    ASSERT_TRUE(pose);
    const CameraLean lean = lean_of(pose->camera.rotation);
    EXPECT_NEAR(lean.tilt_rad, 20 * kDegree_rad, 0.002);
    EXPECT_NEAR(lean.azimuth_rad, -pi / 2, 0.01);
    EXPECT_LT(pose->camera.y_mm, y_grid(shot.pose) * kDefaultSpacing_mm - 5);
}

TEST(SpacePose, NeedsAFocalLengthAFixAndASpacing) {
    const Shot shot = tilted_shot(22, 10, 0);
    Camera camera = camera_of(shot.camera);
    camera.focal_px.reset();
    EXPECT_THROW(require_focal_length(camera), BadArgument);
    EXPECT_THROW(located(shot, camera), BadArgument);
    camera = camera_of(shot.camera);
    EXPECT_NO_THROW(require_focal_length(camera));
    const GreyImage image = render(shot);
    EXPECT_FALSE(space_pose({}, camera, image.view(), {}));
    Fix fix;
    fix.status = Status::ok;
    EXPECT_FALSE(space_pose(fix, camera, image.view(), {}));
    fix.spacing_nm = 0;
    EXPECT_FALSE(space_pose(fix, camera, image.view(), {}));
}

TEST(SpacePose, IsMovedToTheSheetAndTheWorld) {
    SheetEntry entry;
    entry.sheet.origin = {1000, 2000};
    entry.sheet.origin_x_mm = 10;
    entry.sheet.origin_y_mm = 20;
    entry.print_scale_x = 1.01;
    const double x_mm = 0.508 * 1.01;
    CameraInSpace camera;
    camera.x_mm = 1100 * x_mm;
    camera.y_mm = 2050 * 0.508;
    camera.z_mm = -30;
    const CameraInSpace on_page = on_sheet(camera, entry);
    EXPECT_NEAR(on_page.x_mm, 10 + 100 * x_mm, 1e-6);
    EXPECT_NEAR(on_page.y_mm, 20 + 50 * 0.508, 1e-6);
    EXPECT_EQ(on_page.z_mm, -30);

    // The page is rotated anticlockwise by a quarter turn, so its x axis points up in the world.
    // Its y axis, which points down on the page, points to the right in the world.
    SpaceCovariance covariance{};
    covariance[0][0] = 4;
    covariance[3][3] = 1e-6;
    const CameraInWorld world = in_world({100, 200, -30, {}}, covariance, {5, 6, pi / 2});
    EXPECT_NEAR(world.x_m, 5.2, 1e-12);
    EXPECT_NEAR(world.y_m, 6.1, 1e-12);
    EXPECT_NEAR(world.z_m, 0.03, 1e-12);
    const Matrix3 rotation = rotation_of(world.rotation);
    // The image x axis points along the x axis of the page. The optical axis points down.
    EXPECT_NEAR(rotation[1][0], 1, 1e-12);
    EXPECT_NEAR(rotation[2][2], -1, 1e-12);
    EXPECT_NEAR(world.covariance[1][1], 4e-6, 1e-15);
    EXPECT_NEAR(world.covariance[0][0], 0, 1e-15);
    EXPECT_NEAR(world.covariance[4][4], 1e-6, 1e-15);
}

}  // namespace
}  // namespace dotpose
