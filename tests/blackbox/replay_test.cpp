// Tests `dotpose replay` with a log. The expected figures were computed by hand.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kHeader =
    "frame,t_s,file,status,dots_seen,p_wrong,state,events,verdict,plane,track_x_mm,track_y_mm,"
    "vx_mm_s,vy_mm_s\n";

/// A run at ten frames per second:
/// - a drive of 30 mm along x at 100 mm/s,
/// - three lost frames,
/// - a fix 1 m away, and a drive of 40 mm along y at 200 mm/s,
/// - two frames at rest with some noise,
/// - a frame that was accepted only because of the prior.
constexpr const char* kRows =
    "0,0.0,,ok,150,1e-20,moving,fix,accepted,world,0,0,0,0\n"
    "1,0.1,,ok,150,1e-20,moving,,accepted,world,10,0,100,0\n"
    "2,0.2,,ok,150,1e-12,moving,,accepted,world,20,0,100,0\n"
    "3,0.3,,ok,150,1e-20,moving,,accepted,world,30,0,100,0\n"
    "4,0.4,,no_contrast,0,,lost,lost,none,,,,,\n"
    "5,0.5,,no_contrast,0,,lost,,none,,,,,\n"
    "6,0.6,,too_few_dots,9,,lost,,none,,,,,\n"
    "7,0.7,\"a \"\"b\"\", c\",ok,150,1e-20,moving,fix kidnapped,accepted,world,1000,0,0,0\n"
    "8,0.8,,ok,150,1e-20,moving,,accepted,world,1000,-20,0,-200\n"
    "9,0.9,,ok,150,1e-20,moving,,accepted,world,1000,-40,120,160\n"
    "10,1.0,,ok,150,1e-20,stationary,stationary,accepted,world,1000,-40.01,0,0\n"
    "11,1.1,,ok,150,1e-14,stationary,,with_prior,world,1000,-40,0,0\n";

class Replay : public ToolCommand {
  protected:
    void put(const std::string& text) { std::ofstream(directory_ / "run.csv") << text; }
};

TEST_F(Replay, CountsARun) {
    put(std::string(kHeader) + kRows);
    ASSERT_EQ(run("replay run.csv --format json"), 0);
    const json figures = json::parse(output_);
    EXPECT_EQ(figures["frames"], 12);
    EXPECT_NEAR(figures["duration_s"], 1.1, 1e-9);
    EXPECT_EQ(figures["fixes"], 9);
    EXPECT_DOUBLE_EQ(figures["fixes_fraction"], 0.75);
    EXPECT_EQ(figures["without_fix"], (json{{"no_contrast", 2}, {"too_few_dots", 1}}));
    EXPECT_EQ(figures["gaps"], 1);
    EXPECT_NEAR(figures["longest_gap_s"], 0.3, 1e-9);
    EXPECT_EQ(figures["events"],
              (json{{"fix", 2}, {"kidnapped", 1}, {"lost", 1}, {"stationary", 1}}));
    EXPECT_EQ(figures["verdicts"], (json{{"accepted", 8}, {"none", 3}, {"with_prior", 1}}));
    EXPECT_NEAR(figures["distance_mm"], 70, 1e-9);
    EXPECT_NEAR(figures["stationary_s"], 0.2, 1e-9);
    EXPECT_NEAR(figures["mean_speed_mm_s"], 140, 1e-6);
    EXPECT_NEAR(figures["largest_speed_mm_s"], 200, 1e-9);
    EXPECT_DOUBLE_EQ(figures["largest_p_wrong"], 1e-12);
    EXPECT_EQ(figures["planes"], json{"world"});
}

// The robot is lost in the third line, and the fourth line is incomplete.
TEST_F(Replay, ReadsTheJsonLinesOfWatch) {
    put(R"({"schema":1,"frame":0,"t_s":0.0,"status":"ok","dots_seen":150,"p_wrong":1e-20,"state":"moving","events":"fix","verdict":"accepted","plane":"pattern","x_mm":0.0,"y_mm":0.0,"theta_deg":0.0,"covariance_mm_deg":[1e-06,0,0,0,4e-06,0,0,0,9e-06],"track_x_mm":0.0,"track_y_mm":0.0,"track_theta_deg":0.0,"vx_mm_s":0.0,"vy_mm_s":0.0}
{"schema":1,"frame":1,"t_s":0.1,"status":"ok","dots_seen":150,"p_wrong":1e-12,"state":"moving","verdict":"accepted","plane":"pattern","track_x_mm":30.0,"track_y_mm":40.0,"vx_mm_s":300,"vy_mm_s":400}
{"schema":1,"frame":2,"t_s":0.2,"status":"no_contrast","message":"the image has no dark marks on a lighter background","dots_seen":0,"state":"lost","events":"lost","verdict":"none"}
{"schema":1,"frame":3,"t_s":0.3,"sta)");
    ASSERT_EQ(run("replay run.csv --format json"), 0) << errors_;
    const json figures = json::parse(output_);
    EXPECT_EQ(figures["frames"], 3);  // the last line is incomplete
    EXPECT_EQ(figures["fixes"], 2);
    EXPECT_EQ(figures["without_fix"], (json{{"no_contrast", 1}}));
    EXPECT_NEAR(figures["distance_mm"], 50, 1e-9);
    EXPECT_NEAR(figures["largest_speed_mm_s"], 500, 1e-9);
    EXPECT_DOUBLE_EQ(figures["largest_p_wrong"], 1e-12);
    ASSERT_EQ(run("replay run.csv -o run.mcap"), 0) << errors_;
    // The recording contains the variances of the first fix as doubles: 1e-12 and 4e-12 m^2.
    const std::string recording = file("run.mcap");
    for (const double variance_m2 : {1e-6 * 1e-3 * 1e-3, 4e-6 * 1e-3 * 1e-3}) {
        const std::string bytes(reinterpret_cast<const char*>(&variance_m2), sizeof variance_m2);
        EXPECT_NE(recording.find(bytes), std::string::npos) << variance_m2;
    }
}

TEST_F(Replay, RefusesJsonLinesThatAreNotOfWatchInMm) {
    put("{\"schema\":1,\"file\":\"a.pgm\",\"status\":\"ok\"}\n");
    EXPECT_EQ(run("replay run.csv"), 1);
    EXPECT_THAT(errors_, HasSubstr("run.csv:1: not a log of dotpose watch: frame is missing"));
    put("{\"frame\":0,\"t_s\":0.0,\"status\":\"ok\",\"track_x_m\":1.5}\n");
    EXPECT_EQ(run("replay run.csv"), 1);
    EXPECT_THAT(errors_, HasSubstr("its lengths are in m; write it in --units mm"));
    put("{broken\n");
    EXPECT_EQ(run("replay run.csv"), 1);
    EXPECT_THAT(errors_, HasSubstr("run.csv:1: not a log of dotpose watch: "));
}

TEST_F(Replay, PrintsAndDraws) {
    put(std::string(kHeader) + kRows);
    ASSERT_EQ(run("replay run.csv --draw run.svg"), 0);
    EXPECT_THAT(output_, HasSubstr("frames with a fix           9 (75.00 %)\n"));
    EXPECT_THAT(output_, HasSubstr("gaps                        1, the longest 0.300 s\n"));
    const std::string picture = file("run.svg");
    EXPECT_THAT(picture, HasSubstr("speed [mm/s]"));
    EXPECT_THAT(picture, HasSubstr("</svg>"));
    // Each of the three time plots marks the only interval without a fix.
    std::size_t bands = 0;
    for (std::size_t at = picture.find("fill-opacity=\"0.10\""); at != std::string::npos;
         at = picture.find("fill-opacity=\"0.10\"", at + 1)) {
        ++bands;
    }
    EXPECT_EQ(bands, 3U);
}

TEST_F(Replay, NumbersTheAxesOfAPathFarFromTheOrigin) {
    // The path extends 20 mm along x and 10 mm along y. It is 60 km from the origin of the pattern.
    // y points down, as in the pattern frame.
    put(std::string(kHeader) +
        "0,0.0,,ok,150,1e-20,moving,fix,accepted,pattern,59957068.5,9667944,0,0\n"
        "1,0.1,,ok,150,1e-20,moving,,accepted,pattern,59957088.5,9667954,0,0\n");
    ASSERT_EQ(run("replay run.csv --draw run.svg"), 0);
    const std::string picture = file("run.svg");
    EXPECT_THAT(output_,
                HasSubstr("frame of the poses          pattern (y down, angles clockwise); "
                          "for the world, 'dotpose sheets place' before watch\n"));
    EXPECT_THAT(picture, HasSubstr(">y - 9667949 [mm]<"));
    EXPECT_THAT(picture, HasSubstr(R"(text-anchor="end" fill="#6b7885">-10<)"));
    EXPECT_THAT(picture, HasSubstr(R"(text-anchor="end" fill="#6b7885">10<)"));
    EXPECT_THAT(picture, HasSubstr(R"(text-anchor="middle" fill="#6b7885">-10<)"));
}

TEST_F(Replay, LeavesOutALineThatWasCutOff) {
    const std::string rows = kRows;
    put(kHeader + rows.substr(0, rows.size() - 12));
    ASSERT_EQ(run("replay run.csv --format json"), 0);
    EXPECT_EQ(json::parse(output_)["frames"], 11);
}

TEST_F(Replay, OfNoFramesIsNoError) {
    put(kHeader);
    ASSERT_EQ(run("replay run.csv --draw run.svg"), 0);
    EXPECT_THAT(output_, HasSubstr("frames                      0\n"));
    EXPECT_THAT(file("run.svg"), HasSubstr("</svg>"));
}

TEST_F(Replay, RefusesWhatIsNoLog) {
    EXPECT_EQ(run("replay nowhere.csv"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot read nowhere.csv"));
    put("a,b\n1,2\n");
    EXPECT_EQ(run("replay run.csv"), 1);
    EXPECT_EQ(errors_, "dotpose: run.csv:1: not a log of dotpose watch: no column frame\n");
    put(std::string(kHeader) + "1,2\n");
    EXPECT_EQ(run("replay run.csv"), 1);
    EXPECT_EQ(errors_, "dotpose: run.csv:2: not a log of dotpose watch: 2 values instead of 14\n");
    put(std::string(kHeader) + "0,soon,,ok,150,1e-20,moving,fix,accepted,world,0,0,0,0\n");
    EXPECT_EQ(run("replay run.csv"), 1);
    EXPECT_EQ(errors_,
              "dotpose: run.csv:2: not a log of dotpose watch: 'soon' is not a number of t_s\n");
    put("");
    EXPECT_EQ(run("replay run.csv"), 1);
}

}  // namespace
}  // namespace dotpose::test
