// Black-box tests of `dotpose calibrate`, `locate --camera` and `optics`.
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>

#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

class CalibrateCommand : public ToolCommand {
  protected:
    /// Simulates frames with the lens distortion of the camera in the paper, and writes them to a
    /// folder.
    void simulate(const std::string& folder, int frames, const std::string& more = "") {
        ASSERT_EQ(run("simulate -o " + folder + " --seed 91 --k -8.7e-6 --frames " +
                      std::to_string(frames) + " " + more),
                  0)
            << errors_;
    }
};

TEST_F(CalibrateCommand, WritesACameraFileThatLocateReads) {
    simulate("frames", 12);
    ASSERT_EQ(run("calibrate frames/*.pgm -o camera.yaml --draw camera.svg"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("verdict     good"));
    EXPECT_THAT(output_, HasSubstr("12 of 12 located"));
    EXPECT_THAT(file("camera.svg"), HasSubstr("</svg>"));
    ASSERT_EQ(run("locate --camera camera.yaml frames/frame_000003.pgm"), 0) << errors_;
    const json record = json::parse(output_);
    ASSERT_EQ(run("locate --k -8.7e-6 frames/frame_000003.pgm"), 0) << errors_;
    const json known = json::parse(output_);
    EXPECT_NEAR(record["x_mm"].get<double>(), known["x_mm"].get<double>(), 0.006);
    EXPECT_NEAR(record["y_mm"].get<double>(), known["y_mm"].get<double>(), 0.006);
    ASSERT_EQ(run("evaluate frames --camera camera.yaml --format json"), 0) << errors_;
    EXPECT_EQ(json::parse(output_)["wrong"], 0);
}

// Locates frames taken with an unknown lens. The distortion moves each image corner towards or away
// from the image centre, by up to 5 % of the distance between them.
TEST_F(CalibrateCommand, LocateAbsorbsAnUnknownLensOfUpToFivePercent) {
    const auto corner_px = [](int width, int height) {
        return std::hypot((width - 1) / 2.0, (height - 1) / 2.0);
    };
    struct Case {
        const char* size;
        double corner_px;
        int frames;
    };
    for (const Case& c :
         {Case{"188x120", corner_px(188, 120), 40}, Case{"640x480", corner_px(640, 480), 4}}) {
        for (const double fraction : {-0.05, -0.025, 0.025, 0.05}) {
            const std::string k =
                std::to_string(1e6 * fraction / (c.corner_px * c.corner_px)) + "e-6";
            ASSERT_EQ(run("simulate -o frames --seed 92 --size " + std::string(c.size) + " --k " +
                          k + " --frames " + std::to_string(c.frames)),
                      0)
                << errors_;
            ASSERT_EQ(run("evaluate frames --format json"), 0) << errors_;
            const json score = json::parse(output_);
            SCOPED_TRACE(std::string(c.size) + ", k " + k + ": " + output_);
            EXPECT_EQ(score["wrong"], 0);
            EXPECT_GE(score["located"].get<int>(), c.frames - c.frames / 40);
            EXPECT_LT(score["position_um"]["median"].get<double>(), 1.6);
            EXPECT_LT(score["position_um"]["max"].get<double>(), 5);
            EXPECT_LT(score["angle_deg"]["max"].get<double>(), 0.15);
            fs::remove_all(directory_ / "frames");
        }
    }
}

TEST_F(CalibrateCommand, FindsReferenceAndHeading) {
    simulate("turn", 1);
    // The robot turns on the spot. Because the camera is at the robot's centre, the frames show the
    // same position at four angles.
    std::string turn;
    for (const int angle : {0, 90, 180, 270}) {
        const std::string folder = "turn" + std::to_string(angle);
        simulate(folder, 1, "--at 5000 5000 --angle " + std::to_string(angle));
        turn += " " + folder + "/frame_000000.pgm";
    }
    std::string drive;
    for (const int at : {5000, 5040, 5080}) {
        const std::string folder = "drive" + std::to_string(at);
        simulate(folder, 1, "--at " + std::to_string(at) + " 5000 --angle -90");
        drive += " " + folder + "/frame_000000.pgm";
    }
    std::ofstream(directory_ / "lens.yaml")
        << "{format: dotpose-camera, version: 1, width_px: 188, height_px: 120, "
           "k_per_px2: -8.7e-06, centre_px: [93.5, 59.5], mm_per_px: [0.046, 0.046]}";
    ASSERT_EQ(run("calibrate --camera lens.yaml -o robot.yaml --draw turn.svg --spin" + turn +
                  " --drive" + drive),
              0)
        << errors_;
    EXPECT_THAT(file("turn.svg"), HasSubstr("</svg>"));
    EXPECT_THAT(output_, HasSubstr("4 of 4 frames located, over 270 degrees"));
    const std::string yaml = file("robot.yaml");
    double u = 0;
    double v = 0;
    ASSERT_EQ(
        std::sscanf(yaml.c_str() + yaml.find("reference_px: "), "reference_px: [%lf, %lf]", &u, &v),
        2);
    EXPECT_NEAR(u, 93.5, 0.3);
    EXPECT_NEAR(v, 59.5, 0.3);
    // The robot drives along the x axis of the pattern, so its heading is 0 degrees. The angle of
    // the image x axis is -90 degrees, so 90 degrees must be added to this angle to obtain the
    // heading.
    double offset_rad = 0;
    ASSERT_EQ(std::sscanf(yaml.c_str() + yaml.find("theta_offset_rad: "), "theta_offset_rad: %lf",
                          &offset_rad),
              1);
    EXPECT_NEAR(offset_rad, std::acos(0.0), 0.002);
    ASSERT_EQ(run("locate --camera robot.yaml drive5000/frame_000000.pgm"), 0);
    EXPECT_NEAR(json::parse(output_)["theta_deg"].get<double>(), 0, 0.2);
}

TEST_F(CalibrateCommand, FindsTheReadoutTimeAndLocateThenReportsTheVelocity) {
    // Between frames, the camera moves by one spacing, which is 11.04 px, along its x axis. During
    // the readout of one frame, the scene moves by 5 px in the opposite direction, so the readout
    // takes 5 / 11.04 = 0.453 of the time between frames.
    constexpr double kReadout_px = -5;
    constexpr double kSpacing_px = 0.508 / 0.046;
    std::string drive;
    for (int i = 0; i < 8; ++i) {
        const std::string folder = "drive" + std::to_string(i);
        simulate(folder, 1,
                 "--angle 0 --at " + std::to_string(5000 + i) +
                     " 5000 --readout=" + std::to_string(kReadout_px) + ",0");
        drive += " " + folder + "/frame_000000.pgm";
    }
    std::ofstream(directory_ / "camera.yaml")
        << "{format: dotpose-camera, version: 1, width_px: 188, height_px: 120, "
           "k_per_px2: -8.7e-06, centre_px: [93.5, 59.5], mm_per_px: [0.046, 0.046], gain: 3}";
    EXPECT_EQ(run("calibrate --camera camera.yaml -o camera.yaml --rolling" + drive), 2);
    EXPECT_THAT(errors_, HasSubstr("--rolling needs --fps"));
    ASSERT_EQ(run("calibrate --camera camera.yaml -o camera.yaml --fps 20 --rolling" + drive), 0)
        << errors_;
    const std::string yaml = file("camera.yaml");
    double readout_ms = 0;
    ASSERT_EQ(std::sscanf(yaml.c_str() + yaml.find("readout_ms: "), "readout_ms: %lf", &readout_ms),
              1);
    EXPECT_NEAR(readout_ms, 50 * -kReadout_px / kSpacing_px, 0.5);
    EXPECT_THAT(yaml, HasSubstr("gain: 3"));
    ASSERT_EQ(run("locate --camera camera.yaml drive3/frame_000000.pgm"), 0);
    const json fix = json::parse(output_);
    EXPECT_NEAR(fix["velocity_x_mm_s"].get<double>(), 20 * 0.508, 0.3);
    EXPECT_NEAR(fix["velocity_y_mm_s"].get<double>(), 0, 0.3);
    EXPECT_LT(fix["sigma_velocity_x_mm_s"].get<double>(), 0.2);
}

TEST_F(CalibrateCommand, FindsTheFlatFieldAndLocateThenReadsTheSensorOfAMouse) {
    ASSERT_EQ(run("print -o page.pdf --sheets page.json --name page"), 0) << errors_;
    ASSERT_EQ(run("simulate -o drive --drive --sheets page.json --preset mouse --vignetting 0.5 "
                  "--speed 20 --fps 2000 --frames 60"),
              0)
        << errors_;
    const auto located = [&](const std::string& camera) {
        run("locate " + camera + " --sheets page.json --only-sheets drive");
        int count = 0;
        std::istringstream lines(output_);
        for (std::string line; std::getline(lines, line);)
            count += line.find(R"("status":"ok")") != std::string::npos ? 1 : 0;
        return count;
    };
    EXPECT_LE(located(""), 50);
    ASSERT_EQ(run("calibrate -o camera.yaml --flat drive"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("flat field  from 60 frames"));
    EXPECT_GE(located("--camera camera.yaml"), 59);
    EXPECT_EQ(run("calibrate -o other.yaml --flat drive/frame_000000.pgm"), 1);
    EXPECT_THAT(errors_, HasSubstr("at least 20 are needed"));
}

constexpr const char* kMountedCamera =
    "{format: dotpose-camera, version: 1, width_px: 188, height_px: 120, k_per_px2: -8.7e-06, "
    "centre_px: [93.5, 59.5], mm_per_px: [0.046, 0.046], reference_px: [500, 59.5], "
    "theta_offset_rad: 0.25, gain: 3}";

// At the scale given in the camera file, the spacing in the frame is 0.508 mm.
TEST_F(CalibrateCommand, ASpacingThatTheCameraFileContradictsIsReported) {
    simulate("frames", 1);
    std::ofstream(directory_ / "camera.yaml") << kMountedCamera;
    const auto warning = [this](const std::string& spacing) {
        run("locate --camera camera.yaml frames/frame_000000.pgm --spacing " + spacing);
        return json::parse(output_).value("warning", "");
    };
    EXPECT_EQ(warning("0.508"), "");
    EXPECT_EQ(warning("0.498"), "");
    EXPECT_EQ(warning("0.518"), "");
    EXPECT_THAT(warning("0.493"), HasSubstr("a spacing of 0.50"));  // 97 % of the true spacing
    EXPECT_THAT(warning("0.3"), HasSubstr("lengths are computed with 0.3 mm"));

    const std::string before = file("camera.yaml");
    std::string turn;
    for (const int angle : {0, 90, 180, 270}) {
        const std::string folder = "turn" + std::to_string(angle);
        simulate(folder, 1, "--at 5000 5000 --angle " + std::to_string(angle));
        turn += " " + folder + "/frame_000000.pgm";
    }
    EXPECT_EQ(run("calibrate --camera camera.yaml -o camera.yaml --spacing 0.3 --spin" + turn), 1);
    EXPECT_THAT(errors_, HasSubstr("measures a spacing of 0.50"));
    EXPECT_THAT(errors_, HasSubstr("the spacing of the sheet is 0.3 mm"));
    EXPECT_EQ(file("camera.yaml"), before);
}

TEST_F(CalibrateCommand, TakesTheSpacingFromTheSheetFile) {
    // In a new sheet file, the first sheet begins at cell (1024, 1024). The following frames
    // therefore show this sheet.
    ASSERT_EQ(run("print -o fine.svg --spacing 0.3 --sheets sheets.json --name fine"), 0);
    std::string frames;
    for (const int at : {1100, 1130, 1160, 1190, 1220}) {
        const std::string folder = "at" + std::to_string(at);
        ASSERT_EQ(run("simulate -o " + folder +
                      " --spacing 0.3 --section 0,0 --mm-per-px 0.027 --frames 1 --at " +
                      std::to_string(at) + " 1100 --seed " + std::to_string(at)),
                  0)
            << errors_;
        frames += " " + folder + "/frame_000000.pgm";
    }
    const auto scale_of = [this](const char* name) {
        const std::string yaml = file(name);
        double scale = 0;
        EXPECT_EQ(std::sscanf(yaml.c_str() + yaml.find("mm_per_px: "), "mm_per_px: [%lf", &scale),
                  1);
        return scale;
    };
    ASSERT_EQ(run("calibrate --sheets sheets.json -o fine.yaml" + frames), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("spacing     0.3 mm, of the sheet"));
    EXPECT_NEAR(scale_of("fine.yaml"), 0.027, 0.0001);
    ASSERT_EQ(run("calibrate -o assumed.yaml" + frames), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("spacing     0.508 mm, ASSUMED"));
    EXPECT_THAT(output_, HasSubstr("verdict     good if the spacing is 0.508 mm: "));
    EXPECT_NEAR(scale_of("assumed.yaml"), 0.027 * 0.508 / 0.3, 0.0001);

    ASSERT_EQ(run("print -o other.svg --sheets others.json --name other --origin 90000,1024"), 0);
    EXPECT_EQ(run("calibrate --sheets others.json -o other.yaml" + frames), 1);
    EXPECT_THAT(errors_, HasSubstr("no frame shows a sheet of the sheet file"));
    EXPECT_FALSE(fs::exists(directory_ / "other.yaml"));
}

TEST_F(CalibrateCommand, KeepsTheMountOfTheFileThatItReplaces) {
    simulate("frames", 6);
    std::ofstream(directory_ / "camera.yaml") << kMountedCamera;
    ASSERT_EQ(run("calibrate frames/*.pgm -o camera.yaml"), 0) << errors_;
    EXPECT_THAT(errors_, HasSubstr("camera.yaml exists: values that are not calibrated now"));
    EXPECT_THAT(file("camera.yaml"), HasSubstr("theta_offset_rad: 0.25"));
    EXPECT_THAT(file("camera.yaml"), HasSubstr("reference_px: ["));
    EXPECT_THAT(file("camera.yaml"), HasSubstr("gain: 3"));

    // If only the heading is calibrated, the file keeps the lens parameters.
    std::ofstream(directory_ / "camera.yaml") << kMountedCamera;
    std::string drive;
    for (const int at : {5000, 5040, 5080}) {
        const std::string folder = "drive" + std::to_string(at);
        simulate(folder, 1, "--at " + std::to_string(at) + " 5000 --angle -90");
        drive += " " + folder + "/frame_000000.pgm";
    }
    ASSERT_EQ(run("calibrate -o camera.yaml --drive" + drive), 0) << errors_;
    EXPECT_THAT(file("camera.yaml"), HasSubstr("k_per_px2: -8.7e-06"));
    EXPECT_THAT(file("camera.yaml"), HasSubstr("reference_px: [500, 59.5]"));

    // Files for other cameras or in other formats are not overwritten, because their contents would
    // be lost.
    for (const char* other : {kLargeCamera, "{format: another}"}) {
        std::ofstream(directory_ / "camera.yaml") << other;
        EXPECT_EQ(run("calibrate frames/*.pgm -o camera.yaml"), 1);
        EXPECT_THAT(errors_, HasSubstr("another file"));
        EXPECT_EQ(file("camera.yaml"), other);
    }
}

TEST_F(CalibrateCommand, UselessInputIsRefusedAndNothingIsWritten) {
    simulate("one", 1);
    EXPECT_EQ(run("calibrate one/frame_000000.pgm -o camera.yaml"), 1);
    EXPECT_THAT(errors_, HasSubstr("a single frame"));
    EXPECT_EQ(run("calibrate one/*.pgm one/*.pgm -o camera.yaml"), 1);
    EXPECT_THAT(errors_, HasSubstr("the same image"));
    EXPECT_FALSE(fs::exists(directory_ / "camera.yaml"));
    EXPECT_EQ(run("calibrate -o camera.yaml"), 2);
    EXPECT_EQ(run("calibrate missing.png other.png"), 1);
    EXPECT_THAT(errors_, HasSubstr("missing.png"));
    EXPECT_EQ(run("calibrate --stitch one/*.pgm"), 2);
}

TEST_F(CalibrateCommand, ACameraFileOfAnotherSizeIsAnErrorOfEachImage) {
    simulate("frames", 1);
    std::ofstream(directory_ / "large.yaml") << kLargeCamera;
    EXPECT_EQ(run("locate --camera large.yaml frames/frame_000000.pgm"), 1);
    EXPECT_THAT(errors_, HasSubstr(std::string("frame_000000.pgm") + kNotForLargeCamera));
    EXPECT_EQ(run("locate --camera none.yaml frames/frame_000000.pgm"), 1);
    EXPECT_EQ(run("locate --camera large.yaml --k 0 frames/frame_000000.pgm"), 2);
}

TEST_F(CalibrateCommand, OpticsGivesThePapersNumbers) {
    ASSERT_EQ(run("optics --device paper"), 0) << errors_;
    for (const char* number : {"5.39 mm", "353 mm/s", "785 rpm", "10.19 mm"})
        EXPECT_THAT(output_, HasSubstr(number));
    EXPECT_EQ(run("optics --distance 60"), 1);  // too far away
    EXPECT_THAT(output_, HasSubstr("CHANGE: "));
    EXPECT_EQ(run("optics --distance 5"), 2);
    EXPECT_EQ(run("optics --device paper --focal 4"), 2);
}

}  // namespace
}  // namespace dotpose::test
