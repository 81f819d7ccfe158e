// Tests lens calibrations of simulated cameras whose lens distortion, tilt and focal length are
// known.
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "../../xml_check.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"
#include "frames.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate_test;
using testing::HasSubstr;

constexpr int kFrames = 20;
/// Expected residual of nominal frames, in px. It is the root sum of squares of the printing error
/// (0.010 mm, which is 0.217 px) and the measurement noise (about 0.05 px).
constexpr double kNominalResidual_px = 0.222;

/// Maximum error, in reported standard deviations. A normally distributed error exceeds it with a
/// probability of 1/16,000.
constexpr double kMaxSigmas = 4;

void expect_near_truth(const Camera& camera, const char* sigma, double value, double truth) {
    EXPECT_NEAR(value, truth, kMaxSigmas * camera.sigma.at(sigma)) << sigma;
}

void expect_lens(const LensCalibration& result, const CameraModel& truth) {
    const Camera& camera = result.camera;
    EXPECT_NEAR(camera.k_per_px2, truth.k, 0.01 * std::abs(truth.k));
    EXPECT_NEAR(camera.centre_px.u, (truth.width_px - 1) / 2.0, 0.5);
    EXPECT_NEAR(camera.centre_px.v, (truth.height_px - 1) / 2.0, 0.5);
    expect_near_truth(camera, "k_per_px2", camera.k_per_px2, truth.k);
    expect_near_truth(camera, "centre_u_px", camera.centre_px.u, (truth.width_px - 1) / 2.0);
    expect_near_truth(camera, "centre_v_px", camera.centre_px.v, (truth.height_px - 1) / 2.0);
    EXPECT_LT(result.residual_px, 1.1 * kNominalResidual_px);
    EXPECT_EQ(result.located, result.frames);
    EXPECT_EQ(result.verdict, CalibrationVerdict::good) << result.advice;
}

TEST(CalibrateLens, FindsThePapersLens) {
    const CameraModel truth = paper_camera();
    const auto result =
        calibrate_lens(kFrames, [&](int i) { return nominal_frame(truth, 31, i); }, {});
    expect_lens(result, truth);
    ASSERT_TRUE(result.is_mounted);
    const PaperScale& paper = result.camera.paper.value();
    // The mean scale over the 188 x 120 px field of view is determined more accurately than the
    // scale at its centre.
    EXPECT_NEAR(paper.mm_per_px_x, truth.mm_per_px, 5e-4 * truth.mm_per_px);
    EXPECT_NEAR(paper.mm_per_px_y, truth.mm_per_px, 5e-4 * truth.mm_per_px);
    expect_near_truth(result.camera, "mm_per_px_x", paper.mm_per_px_x, truth.mm_per_px);
    expect_near_truth(result.camera, "mm_per_px_y", paper.mm_per_px_y, truth.mm_per_px);
    expect_near_truth(result.camera, "skew", paper.skew, 0);
    // Frames from a camera that looks straight down do not determine the focal length.
    EXPECT_FALSE(result.camera.focal_px.has_value());
    // Without a correction of the lens distortion, most of the residual is caused by the
    // distortion.
    EXPECT_GT(result.residual_before_px, 3 * result.residual_px);
    EXPECT_EQ(result.coverage, 1);
}

TEST(CalibrateLens, FindsTheTiltOfAMountedCamera) {
    const CameraModel truth = paper_camera();
    const auto result =
        calibrate_lens(kFrames, [&](int i) { return nominal_frame(truth, 32, i, 20, -15); }, {});
    expect_lens(result, truth);
    EXPECT_TRUE(result.is_mounted);
    const double focal_px = truth.working_distance_mm / truth.mm_per_px;
    ASSERT_TRUE(result.camera.focal_px && result.camera.tilt);
    EXPECT_NEAR(*result.camera.focal_px, focal_px, 0.02 * focal_px);
    expect_near_truth(result.camera, "focal_px", *result.camera.focal_px, focal_px);
    expect_near_truth(result.camera, "tilt_x_rad", result.camera.tilt->x_rad, 20 * kDegree_rad);
    expect_near_truth(result.camera, "tilt_y_rad", result.camera.tilt->y_rad, -15 * kDegree_rad);
}

// Regression: when the calibration used only the dots that `locate` reads, the focal length of a
// slightly tilted camera was wrong by three standard deviations.
TEST(CalibrateLens, ASlightTiltTellsAnUnbiasedFocalLength) {
    const CameraModel truth = paper_camera();
    const double focal_px = truth.working_distance_mm / truth.mm_per_px;
    constexpr int kSeries = 4;
    double normalised = 0;
    for (int series = 0; series < kSeries; ++series) {
        const auto frame_at = [&](int i) {
            return nominal_frame(truth, 41 + static_cast<std::uint64_t>(series), i, -7.65, -3.08);
        };
        const Camera camera = calibrate_lens(kFrames, frame_at, {}).camera;
        ASSERT_TRUE(camera.focal_px);
        normalised += (*camera.focal_px - focal_px) / camera.sigma.at("focal_px");
    }
    EXPECT_LT(std::abs(normalised) / std::sqrt(kSeries), kMaxSigmas);
}

// In the farthest corner of the image, the spacing in pixels is half as large as in the middle.
TEST(CalibrateLensAtLength, AStrongTiltIsCoveredToTheCorners) {
    CameraModel truth;
    truth.width_px = 640;
    truth.height_px = 480;
    truth.k = -0.7e-6;
    truth.working_distance_mm = 30;
    const auto result =
        calibrate_lens(6, [&](int i) { return nominal_frame(truth, 42, i, -19, 25); }, {});
    EXPECT_EQ(result.verdict, CalibrationVerdict::good) << result.advice;
    EXPECT_EQ(result.coverage, 1);
    ASSERT_TRUE(result.camera.tilt);
    expect_near_truth(result.camera, "tilt_x_rad", result.camera.tilt->x_rad, -19 * kDegree_rad);
    expect_near_truth(result.camera, "tilt_y_rad", result.camera.tilt->y_rad, 25 * kDegree_rad);
}

TEST(CalibrateLensAtLength, FindsTheFocalLengthOfALargeCameraHeldByHand) {
    CameraModel truth;
    truth.width_px = 640;
    truth.height_px = 480;
    truth.k = -0.7e-6;
    truth.working_distance_mm = 30;
    const auto frame_at = [&](int i) {
        return nominal_frame(truth, 33, i, i * 7 % 51 - 25, i * 13 % 51 - 25);
    };
    const auto result = calibrate_lens(8, frame_at, {});
    expect_lens(result, truth);
    EXPECT_FALSE(result.is_mounted);
    EXPECT_FALSE(result.camera.paper || result.camera.tilt);
    const double focal_px = truth.working_distance_mm / truth.mm_per_px;
    ASSERT_TRUE(result.camera.focal_px);
    EXPECT_NEAR(*result.camera.focal_px, focal_px, 0.001 * focal_px);
    expect_near_truth(result.camera, "focal_px", *result.camera.focal_px, focal_px);
}

TEST(CalibrateLens, FindsACentreOffTheMiddle) {
    // The frame is cut out of a larger frame, so the centre of distortion is not in the middle of
    // the frame.
    CameraModel larger = paper_camera();
    larger.width_px = 200;
    larger.height_px = 124;
    const auto frame_at = [&](int index) {
        const GreyImage whole = nominal_frame(larger, 34, index);
        GreyImage part{{}, 188, 120};
        for (int v = 0; v < part.height_px; ++v) {
            const auto row = whole.pixels.begin() + v * whole.width_px;
            part.pixels.insert(part.pixels.end(), row, row + part.width_px);
        }
        return part;
    };
    const Camera camera = calibrate_lens(kFrames, frame_at, {}).camera;
    EXPECT_NEAR(camera.centre_px.u, 99.5, 0.8);
    EXPECT_NEAR(camera.centre_px.v, 61.5, 0.5);
    expect_near_truth(camera, "centre_u_px", camera.centre_px.u, 99.5);
    expect_near_truth(camera, "centre_v_px", camera.centre_px.v, 61.5);
    EXPECT_NEAR(camera.k_per_px2, larger.k, 0.01 * std::abs(larger.k));
}

TEST(CalibrateLens, ALensWithoutDistortionStaysInTheMiddle) {
    const auto result = calibrate_lens(kFrames, [](int i) { return nominal_frame({}, 35, i); }, {});
    expect_near_truth(result.camera, "k_per_px2", result.camera.k_per_px2, 0);
    EXPECT_NEAR(result.camera.centre_px.u, 93.5, 12);
    EXPECT_NEAR(result.camera.centre_px.v, 59.5, 12);
}

std::string refusal(int frames, const FrameAt& frame_at) {
    try {
        calibrate_lens(frames, frame_at, {});
    } catch (const Error& error) {
        return error.what();
    }
    return "not refused";
}

TEST(CalibrateLens, RefusesUselessFramesWithAdvice) {
    const auto usual = [](int i) { return nominal_frame(paper_camera(), 36, i); };
    EXPECT_THAT(refusal(1, usual), HasSubstr("take 5 to 50 frames at different places"));
    EXPECT_THAT(refusal(3,
                        [](int i) {
                            GreyImage blank{{}, 188, 120};
                            blank.pixels.assign(188 * 120, static_cast<std::uint8_t>(200 + i));
                            return blank;
                        }),
                HasSubstr("no pattern was found in any of the 3 frames"));
    EXPECT_THAT(refusal(6, [&](int) { return usual(0); }),
                HasSubstr("all 6 frames are the same image: move the camera"));
    EXPECT_THAT(refusal(6,
                        [&](int i) {
                            CameraModel camera = paper_camera();
                            camera.width_px = i == 4 ? 190 : 188;
                            return nominal_frame(camera, 36, i);
                        }),
                HasSubstr("188 x 120 and 190 x 120 px"));
    EXPECT_THROW(calibrate_lens(0, usual, {}), BadArgument);
}

TEST(CalibrateLens, SaysWhatIsWrongWithPoorSeries) {
    const CameraModel camera = paper_camera();
    const auto few = calibrate_lens(4, [&](int i) { return nominal_frame(camera, 37, i); }, {});
    EXPECT_EQ(few.verdict, CalibrationVerdict::too_few_frames);

    dotpose::Setup setup;
    setup.camera = camera;
    const auto same_place =
        calibrate_lens(6,
                       [&](int i) {
                           const Shot shot = draw_shot(setup, static_cast<std::uint64_t>(i));
                           return render(moved_to(shot, 5000 + 0.05 * i, 5000, 0.1 * i));
                       },
                       {});
    EXPECT_EQ(same_place.verdict, CalibrationVerdict::same_place);

    const auto blurred = calibrate_lens(8,
                                        [&](int i) {
                                            Shot shot =
                                                draw_shot(setup, static_cast<std::uint64_t>(i));
                                            shot.imperfections.blur_sigma_px = 1.7;
                                            shot.imperfections.motion_px = {};
                                            return render(shot);
                                        },
                                        {});
    EXPECT_EQ(blurred.verdict, CalibrationVerdict::out_of_focus) << blurred.dot_width;
    EXPECT_LT(few.dot_width, 0.25);  // the frames are sharp: their blur is 0.4 to 0.7 px
}

TEST(CalibrateLens, CountsFramesThatAreGivenTwiceOnce) {
    const auto result =
        calibrate_lens(7, [](int i) { return nominal_frame(paper_camera(), 38, i % 4); }, {});
    EXPECT_EQ(result.duplicates, 3);
    EXPECT_EQ(result.located, 4);
    EXPECT_EQ(result.verdict, CalibrationVerdict::too_few_frames);
    EXPECT_THAT(result.advice, HasSubstr("only 4 different frames"));

    const auto each_twice =
        calibrate_lens(12, [](int i) { return nominal_frame(paper_camera(), 38, i / 2); }, {});
    EXPECT_EQ(each_twice.duplicates, 6);
    EXPECT_EQ(each_twice.located, 6);
    EXPECT_NE(each_twice.verdict, CalibrationVerdict::too_few_frames);
}

TEST(CalibrateLens, CanBeStopped) {
    CalibrateOptions options;
    options.progress = [](int done, int) { return done < 3; };
    EXPECT_THROW(calibrate_lens(
                     8, [](int i) { return nominal_frame({}, 39, i); }, options),
                 Error);
}

TEST(DrawCalibration, IsAPictureOfThreePanels) {
    const auto result =
        calibrate_lens(5, [](int i) { return nominal_frame(paper_camera(), 40, i); }, {});
    const test::TemporaryDirectory directory;
    const auto path = directory.path() / "calibration.svg";
    draw_calibration(path, result);
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    EXPECT_EQ(test::XmlCheck(text.str()).problem(), "");
    for (const char* panel : {">Before<", ">After<", ">Coverage<"})
        EXPECT_THAT(text.str(), HasSubstr(panel));
    EXPECT_THROW(draw_calibration("/no/such/folder/a.svg", result), Error);
}

}  // namespace
}  // namespace dotpose
