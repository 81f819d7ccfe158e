// Tests camera files: their keys, errors and geometry, and ROS camera_info files.
#include "dotpose/files/camera_file.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "../calibrate/frames.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kWhole = R"(format: dotpose-camera
version: 1
width_px: 188
height_px: 120
k_per_px2: -8.7e-06
centre_px: [93.75, 59.25]
mm_per_px: [0.046, 0.0461]
skew: 0.001
perspective_per_px: [1e-05, -2e-05]
focal_px: 348
tilt_rad: [0.1, -0.05]
reference_px: [400.5, -12]
theta_offset_rad: 1.5
tip_mm: [0.5, -5, 18]
tip_rest_mm: 0.125
flat_field:
  - [0.5, 0.75, 0.6]
  - [0.8, 1, 0.7]
exposure_us: 130
gain: 2
sigma:
  k_per_px2: 2e-08
)";

class CameraFile : public testing::Test {
  protected:
    Camera read(const std::string& text) const {
        std::ofstream(path_) << text;
        return read_camera(path_);
    }
    std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "not refused";
    }
    /// Returns the error message for kWhole with `part` replaced by `other`.
    std::string refusal_with(const std::string& part, const std::string& other) const {
        std::string text = kWhole;
        text.replace(text.find(part), part.size(), other);
        return refusal(text);
    }

    test::TemporaryDirectory directory_;
    std::filesystem::path path_ = directory_.path() / "camera.yaml";
};

void expect_whole(const Camera& camera) {
    EXPECT_EQ(camera.width_px, 188);
    EXPECT_EQ(camera.height_px, 120);
    EXPECT_DOUBLE_EQ(camera.k_per_px2, -8.7e-6);
    EXPECT_DOUBLE_EQ(camera.centre_px.u, 93.75);
    EXPECT_DOUBLE_EQ(camera.centre_px.v, 59.25);
    EXPECT_DOUBLE_EQ(camera.paper.value().mm_per_px_x, 0.046);
    EXPECT_DOUBLE_EQ(camera.paper.value().mm_per_px_y, 0.0461);
    EXPECT_DOUBLE_EQ(camera.paper.value().skew, 0.001);
    EXPECT_DOUBLE_EQ(camera.paper.value().perspective_u, 1e-5);
    EXPECT_DOUBLE_EQ(camera.paper.value().perspective_v, -2e-5);
    EXPECT_DOUBLE_EQ(camera.focal_px.value(), 348);
    EXPECT_DOUBLE_EQ(camera.tilt.value().x_rad, 0.1);
    EXPECT_DOUBLE_EQ(camera.tilt.value().y_rad, -0.05);
    EXPECT_DOUBLE_EQ(camera.reference_px.value().u, 400.5);
    EXPECT_DOUBLE_EQ(camera.reference_px.value().v, -12);
    EXPECT_DOUBLE_EQ(camera.theta_offset_rad, 1.5);
    EXPECT_DOUBLE_EQ(camera.tip.value().x_mm, 0.5);
    EXPECT_DOUBLE_EQ(camera.tip.value().y_mm, -5);
    EXPECT_DOUBLE_EQ(camera.tip.value().z_mm, 18);
    EXPECT_DOUBLE_EQ(camera.tip.value().rest_mm, 0.125);
    EXPECT_DOUBLE_EQ(camera.exposure_us.value(), 130);
    EXPECT_DOUBLE_EQ(camera.gain.value(), 2);
    EXPECT_DOUBLE_EQ(camera.sigma.at("k_per_px2"), 2e-8);
}

TEST_F(CameraFile, IsReadAndWrittenWithAllKeys) {
    const Camera camera = read(kWhole);
    expect_whole(camera);
    write_camera(path_, camera);
    expect_whole(read_camera(path_));
}

TEST_F(CameraFile, NeedsTheLensOnly) {
    const Camera camera = read(
        "{format: dotpose-camera, version: 1, width_px: 640, height_px: 480, k_per_px2: 0, "
        "centre_px: [319.5, 239.5]}");
    EXPECT_FALSE(camera.paper || camera.focal_px || camera.tilt || camera.reference_px);
    EXPECT_EQ(camera.theta_offset_rad, 0);
}

TEST_F(CameraFile, WrongFilesAreRefusedByKey) {
    EXPECT_THAT(refusal_with("format: dotpose-camera", "format: dotpose-sheets"),
                HasSubstr(": format is 'dotpose-sheets'"));
    EXPECT_THAT(refusal_with("version: 1", "version: 2"), HasSubstr("version is 2"));
    EXPECT_THAT(refusal_with("[0.5, -5, 18]", "[0.5, -5]"), HasSubstr("tip_mm"));
    EXPECT_THAT(refusal_with("[0.5, -5, 18]", "[0.5, -5, 1e5]"),
                HasSubstr("tip_mm must be within 10000 mm"));
    EXPECT_THAT(refusal_with("tip_mm: [0.5, -5, 18]\n", ""), HasSubstr("tip_rest_mm needs tip_mm"));
    EXPECT_THAT(refusal_with("k_per_px2: -8.7e-06\n", ""), HasSubstr("k_per_px2 is missing"));
    EXPECT_THAT(refusal_with("k_per_px2: -8.7e-06", "k_per_px2: barrel"),
                HasSubstr("k_per_px2 must be a number"));
    EXPECT_THAT(refusal_with("-8.7e-06", ".nan"), HasSubstr("k_per_px2 must be finite"));
    EXPECT_THAT(refusal_with("-8.7e-06", "-8.7e-03"), HasSubstr("k_per_px2 -0.0087 folds"));
    EXPECT_THAT(refusal_with("[93.75, 59.25]", "93.75"),
                HasSubstr("centre_px must be a list of numbers"));
    EXPECT_THAT(refusal_with("[93.75, 59.25]", "[93.75, 59.25, 1]"),
                HasSubstr("centre_px must be a list of 2 numbers"));
    EXPECT_THAT(refusal_with("[93.75, 59.25]", "[2000, 59.25]"), HasSubstr("centre_px is more"));
    EXPECT_THAT(refusal_with("width_px: 188", "width_px: 18.5"),
                HasSubstr("width_px must be a whole number"));
    EXPECT_THAT(refusal_with("width_px: 188", "width_px: 8"), HasSubstr("width_px must be 24"));
    EXPECT_THAT(refusal_with("[0.046, 0.0461]", "[0, 0.0461]"), HasSubstr("mm_per_px must be"));
    EXPECT_THAT(refusal_with("reference_px", "refrence_px"),
                HasSubstr("refrence_px is not a key of a camera file"));
    EXPECT_THAT(refusal_with("  k_per_px2: 2e-08", "  k_per_px2: [1]"),
                HasSubstr("sigma.k_per_px2 must be a number"));
    EXPECT_THAT(refusal_with("gain: 2", "gain: -2"), HasSubstr("gain must be above 0"));
}

TEST_F(CameraFile, AFlatFieldIsARectangleOfFractions) {
    const Camera camera = read(kWhole);
    const std::vector<std::vector<double>> expected{{0.5, 0.75, 0.6}, {0.8, 1, 0.7}};
    EXPECT_EQ(camera.flat_field, expected);
    EXPECT_THAT(refusal_with("0.75, 0.6]", "0.75]"), HasSubstr("flat_field must have rows of the"));
    for (const char* value : {"0.04", "1.01", "-1", "0"}) {
        EXPECT_THAT(refusal_with("0.75", value),
                    HasSubstr("flat_field must have values from 0.05 to 1"));
    }
    EXPECT_THAT(refusal_with("0.75", "bright"), HasSubstr("flat_field must be a number"));
    EXPECT_THAT(refusal_with("  - [0.8, 1, 0.7]\n", ""), HasSubstr("2 or more rows and columns"));
    EXPECT_THAT(refusal_with("  - [0.8, 1, 0.7]\n", "  - 1\n"),
                HasSubstr("flat_field must be a list of rows, each a list of numbers"));
    EXPECT_THAT(refusal_with("height_px: 120", "height_px: 23"),
                HasSubstr("height_px must be 24 to 4096"));
}

TEST_F(CameraFile, ForeignFilesAreRefused) {
    EXPECT_THAT(refusal("name: a robot\n"),
                HasSubstr("format is missing: this is not a camera file"));
    EXPECT_THAT(refusal("just words"), HasSubstr("not a camera file"));
    EXPECT_THAT(refusal("a: [1, 2"), HasSubstr("not YAML: line"));
    EXPECT_THAT(refusal(""), HasSubstr("not a camera file"));
    std::filesystem::remove(path_);
    EXPECT_THROW(read_camera(path_), Error);
    try {
        read_camera("/no/such/file.yaml");
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "cannot read /no/such/file.yaml: No such file or directory");
    }
}

TEST(CameraGeometry, IsEquations1And2AndTheirInverse) {
    Camera camera;
    camera.width_px = 188;
    camera.height_px = 120;
    camera.k_per_px2 = -8.7e-6;
    camera.centre_px = {95, 58};
    camera.paper = PaperScale{0.046, 0.047, 0.02, 1e-4, -2e-4};
    Rng rng(71);
    for (int i = 0; i < 200; ++i) {
        const PixelPoint pixel{rng.uniform(0, 187), rng.uniform(0, 119)};
        const double du = pixel.u - 95;
        const double dv = pixel.v - 58;
        const double divisor = 1 - 8.7e-6 * (du * du + dv * dv);
        const PixelPoint straight = undistorted(camera, pixel);
        ASSERT_NEAR(straight.u, 95 + du / divisor, 1e-9);
        ASSERT_NEAR(straight.v, 58 + dv / divisor, 1e-9);
        const PixelPoint again = distorted(camera, straight);
        ASSERT_NEAR(again.u, pixel.u, 1e-9);
        ASSERT_NEAR(again.v, pixel.v, 1e-9);
        const PixelPoint there = on_image(camera, on_paper(camera, straight));
        ASSERT_NEAR(there.u, straight.u, 1e-9);
        ASSERT_NEAR(there.v, straight.v, 1e-9);
    }
}

TEST(CameraGeometry, TheScaleIsThatOfATiltedCamera) {
    // Compares `on_paper` with the simulator's pinhole camera.
    CameraModel model;
    CameraPose pose;
    pose.tilt_x_rad = 0.3;
    pose.tilt_y_rad = -0.2;
    const Projection projection(model, pose);
    const double f = model.working_distance_mm / model.mm_per_px;
    Camera camera;
    camera.centre_px = {93.5, 59.5};
    // The axes of the paper in the camera frame are (cy, sx sy, -cx sy) and (0, cx, sx), where sx,
    // cx, sy and cy are the sines and cosines of the two tilts. Their cross product is the normal
    // n. The depth of a pixel is inversely proportional to the scalar product of n and the viewing
    // ray of the pixel.
    const double nx = std::sin(-0.2);
    const double ny = -std::sin(0.3) * std::cos(-0.2);
    const double nz = std::cos(0.3) * std::cos(-0.2);
    // First derivatives are computed by finite differences.
    const double h = 1e-4;
    const auto at = [&](double u, double v) { return projection.offset_from_pixel({u, v}); };
    const double x_u = (at(93.5 + h, 59.5).x - at(93.5 - h, 59.5).x) / (2 * h);
    const double x_v = (at(93.5, 59.5 + h).x - at(93.5, 59.5 - h).x) / (2 * h);
    const double y_v = (at(93.5, 59.5 + h).y - at(93.5, 59.5 - h).y) / (2 * h);
    camera.paper = PaperScale{x_u, y_v, x_v / x_u, nx / (nz * f), ny / (nz * f)};
    for (const auto& [u, v] : {std::pair(10.0, 20.0), std::pair(180.0, 100.0)}) {
        const CameraPoint point = on_paper(camera, {u, v});
        EXPECT_NEAR(point.x_mm, at(u, v).x, 1e-6);
        EXPECT_NEAR(point.y_mm, at(u, v).y, 1e-6);
    }
}

const std::string kRos = R"(image_width: 640
image_height: 480
camera_name: down
camera_matrix:
  rows: 3
  cols: 3
  data: [600, 0, 330, 0, 600, 236, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.25, 0.1, 0, 0, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)";

/// Returns the pixel at which the camera described by kRos sees the point (x, y, 1), with OpenCV's
/// lens model.
PixelPoint seen_by_ros(double x, double y) {
    const double r2 = x * x + y * y;
    const double radial = 1 - 0.25 * r2 + 0.1 * r2 * r2;
    return {330 + 600 * radial * x, 236 + 600 * radial * y};
}

TEST_F(CameraFile, ALensOfRosIsConvertedNotRelabelled) {
    const Camera camera = read(kRos);
    EXPECT_EQ(camera.width_px, 640);
    EXPECT_NEAR(camera.focal_px.value(), 600, 1e-9);
    EXPECT_NEAR(camera.centre_px.u, 330, 2);
    EXPECT_NEAR(camera.centre_px.v, 236, 2);
    // Undistorted lines must be straight in the whole image. The tolerance allows for the error of
    // a lens model with a single coefficient.
    for (const double offset : {-0.3, -0.1, 0.2, 0.3}) {
        for (const bool is_row : {true, false}) {
            const auto point = [&](double along) {
                return undistorted(
                    camera, is_row ? seen_by_ros(along, offset) : seen_by_ros(offset, along));
            };
            const double reach = is_row ? 0.48 : 0.36;
            const PixelPoint a = point(-reach);
            const PixelPoint b = point(reach);
            const double length = std::hypot(b.u - a.u, b.v - a.v);
            for (double along = -reach; along < reach; along += 0.04) {
                const PixelPoint p = point(along);
                const double off = ((b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u)) / length;
                EXPECT_NEAR(off, 0, 0.5) << offset << " " << along;
            }
        }
    }
}

TEST_F(CameraFile, ALensOfRosKeepsItsDirectionsOfView) {
    const Camera camera = read(kRos);
    const Pinhole pinhole = pinhole_of(camera).value();
    for (double x = -0.48; x <= 0.48; x += 0.08) {
        for (double y = -0.36; y <= 0.36; y += 0.08) {
            const PixelPoint at = undistorted(camera, seen_by_ros(x, y));
            EXPECT_NEAR((at.u - pinhole.centre_px.u) / pinhole.focal_u_px, x, 1e-3) << y;
            EXPECT_NEAR((at.v - pinhole.centre_px.v) / pinhole.focal_v_px, y, 1e-3) << x;
        }
    }
    write_camera(path_, camera);
    const Pinhole again = pinhole_of(read_camera(path_)).value();
    EXPECT_NEAR(again.focal_u_px, pinhole.focal_u_px, 1e-6);
    EXPECT_NEAR(again.centre_px.v, pinhole.centre_px.v, 1e-6);
}

TEST_F(CameraFile, SquarePixelsHaveTheirAxisAtTheDistortionCentre) {
    Camera camera = read(kWhole);
    camera.pinhole.reset();
    camera.focal_px = 500;
    EXPECT_EQ(pinhole_of(camera)->focal_v_px, 500);
    EXPECT_EQ(pinhole_of(camera)->centre_px.u, camera.centre_px.u);
    camera.focal_px.reset();
    EXPECT_FALSE(pinhole_of(camera));
    camera.pinhole = Pinhole{500, 510, {100, 50}};
    EXPECT_EQ(part_of(camera, 8, 4, 100, 80).pinhole->centre_px.u, 92);
    camera.pinhole->focal_v_px = 0;
    EXPECT_THROW(validate(camera), BadArgument);
}

TEST_F(CameraFile, APrintedMessageOfRosIsReadAsWell) {
    const Camera camera = read(
        "header: {frame_id: down}\nheight: 480\nwidth: 640\ndistortion_model: plumb_bob\n"
        "D: [-0.25, 0.1, 0, 0, 0]\nK: [600, 0, 330, 0, 600, 236, 0, 0, 1]\n---\n");
    const Camera same = read(kRos);
    EXPECT_EQ(camera.k_per_px2, same.k_per_px2);
    EXPECT_EQ(camera.centre_px.u, same.centre_px.u);
}

TEST_F(CameraFile, KeepsThatFramesAreMirrored) {
    EXPECT_FALSE(read(kWhole).flip);
    Camera camera = read(kWhole + "flip: true\n");
    EXPECT_TRUE(camera.flip);
    write_camera(path_, camera);
    EXPECT_TRUE(read_camera(path_).flip);
    EXPECT_THAT(refusal(kWhole + "flip: 3\n"), HasSubstr("flip must be true or false"));
}

TEST_F(CameraFile, AMissingFileIsToldWithTheReason) {
    std::string error;
    try {
        read_camera("nothere.yaml");
    } catch (const Error& thrown) {
        error = thrown.what();
    }
    EXPECT_EQ(error, "cannot read nothere.yaml: No such file or directory");
}

// Some drivers write rational_polynomial for every camera. If the terms that plumb_bob lacks are
// zero, the two models are equal.
TEST_F(CameraFile, ARationalPolynomialWithoutItsOwnTermsIsPlumbBob) {
    const auto rational = [](const std::string& coefficients) {
        std::string text = kRos;
        text.replace(text.find("plumb_bob"), 9, "rational_polynomial");
        text.replace(text.find("[-0.25, 0.1, 0, 0, 0]"), 21, coefficients);
        return text;
    };
    EXPECT_EQ(read(rational("[-0.25, 0.1, 0, 0, 0, 0, 0, 0]")).k_per_px2, read(kRos).k_per_px2);
    EXPECT_EQ(read(rational("[-0.25, 0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]")).k_per_px2,
              read(kRos).k_per_px2);
    EXPECT_THAT(refusal(rational("[-0.25, 0.1, 0, 0, 0, 0.2, 0, 0]")),
                HasSubstr("k4 to k6 other than 0, which cannot be read: use 'dotpose calibrate'"));
}

TEST_F(CameraFile, OtherLensesOfRosAreRefusedByKey) {
    const auto with = [&](const std::string& part, const std::string& other) {
        std::string text = kRos;
        text.replace(text.find(part), part.size(), other);
        return refusal(text);
    };
    EXPECT_THAT(with("plumb_bob", "equidistant"),
                HasSubstr("distortion_model is 'equidistant'; only plumb_bob can be read: use "
                          "'dotpose calibrate'"));
    EXPECT_THAT(with("[600, 0,", "[0, 0,"), HasSubstr("camera_matrix has no focal lengths"));
    EXPECT_THAT(with("[-0.25, 0.1, 0, 0, 0]", "[-0.25, 0.05]"),
                HasSubstr("distortion_coefficients must be"));
    EXPECT_THAT(with("[-0.25, 0.1, 0, 0, 0]", "[0.9, -9.0, 0, 0, 30]"),
                HasSubstr("distortion_coefficients describe a lens"));
    EXPECT_THAT(with("image_width: 640\n", ""), HasSubstr("image_width is missing"));
}

TEST(UseCamera, SetsLensAndReferenceForItsOwnSizeOnly) {
    Camera camera;
    camera.width_px = 188;
    camera.height_px = 120;
    camera.k_per_px2 = -8.7e-6;
    camera.centre_px = {94, 58.5};
    camera.reference_px = PixelPoint{-6.5, 61.5};
    DeviceOptions options;
    use_camera(camera, 188, 120, options);
    EXPECT_NEAR(options.lens.k_q40 * 0x1p-40, -8.7e-6, 1e-12);
    EXPECT_EQ(options.lens.centre_dx_q8, 128);
    EXPECT_EQ(options.lens.centre_dy_q8, -256);
    EXPECT_EQ(options.reference_dx_q8, -100 * 256);
    EXPECT_EQ(options.reference_dy_q8, 2 * 256);
    EXPECT_THROW(use_camera(camera, 189, 120, options), BadArgument);
}

// If only part of the image is read, each pixel still shows the same point on the paper, and the
// reference point and the heading remain the same.
TEST(PartOf, SeesTheSamePaper) {
    Camera camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.k_per_px2 = -2e-7;
    camera.centre_px = {325, 236};
    camera.paper = PaperScale{0.046, 0.0461, 0.001, 1e-4, -2e-4};
    camera.theta_offset_rad = 0.5;
    const Camera part = part_of(camera, 100, 50, 400, 300);
    EXPECT_EQ(part.width_px, 400);
    EXPECT_EQ(part.height_px, 300);
    const CameraPoint whole_at = on_paper(camera, undistorted(camera, {130, 90}));
    const CameraPoint part_at = on_paper(part, undistorted(part, {30, 40}));
    EXPECT_NEAR(part_at.x_mm, whole_at.x_mm, 1e-12);
    EXPECT_NEAR(part_at.y_mm, whole_at.y_mm, 1e-12);
    // By default, the reference point is the centre of the whole image.
    EXPECT_NEAR(part.reference_px.value().u, 319.5 - 100, 1e-12);
    EXPECT_NEAR(part.reference_px.value().v, 239.5 - 50, 1e-12);
    // In the camera frame, the heading is relative to the direction of the image x axis at the
    // image centre.
    const double heading_rad = image_axis_rad(camera, {319.5, 239.5}) + camera.theta_offset_rad;
    EXPECT_NEAR(image_axis_rad(part, {199.5, 149.5}) + part.theta_offset_rad, heading_rad, 1e-12);
    EXPECT_THROW(part_of(camera, 300, 50, 400, 300), BadArgument);
    EXPECT_THROW(part_of(camera, -1, 50, 400, 300), BadArgument);
}

/// Regression: the flat field of the whole image was stretched over the crop, and the readout time
/// was that of the whole image.
TEST_F(CameraFile, ACropHasItsPartOfTheFlatFieldAndOfTheReadoutTime) {
    Camera camera;
    camera.width_px = 641;
    camera.height_px = 481;
    // The brightness decreases by 1/1600 per pixel along u, and by 1/2400 along v.
    camera.flat_field = {{1.0, 0.8, 0.6}, {0.8, 0.6, 0.4}};
    camera.readout_ms = 48.1;
    const Camera part = part_of(camera, 160, 240, 321, 121);
    EXPECT_NEAR(part.flat_field[0][0], 1 - 160.0 / 1600 - 240.0 / 2400, 1e-12);
    EXPECT_NEAR(part.flat_field[1][2], 1 - 480.0 / 1600 - 360.0 / 2400, 1e-12);
    EXPECT_NEAR(brightness_at(part, {10, 30}), brightness_at(camera, {170, 270}), 1e-12);
    EXPECT_NEAR(part.readout_ms.value(), 12.1, 1e-12);
}

}  // namespace
}  // namespace dotpose
