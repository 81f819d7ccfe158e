// `dotpose simulate` as its user sees it.
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);)
        parts.push_back(part);
    return parts;
}

/// Runs `dotpose simulate ARGUMENTS`.
class SimulateCommand : public ToolCommand {
  protected:
    int run(const std::string& arguments) { return ToolCommand::run("simulate " + arguments); }
    std::vector<std::string> truth_rows(const std::string& folder) const {
        return split(file(folder + "/truth.csv"), '\n');
    }
};

TEST_F(SimulateCommand, WritesFramesAndTheirTruth) {
    ASSERT_EQ(run("-o frames --frames 12 --preset hard --seed 5"), 0) << errors_;
    const std::vector<std::string> rows = truth_rows("frames");
    ASSERT_EQ(rows.size(), 13u);
    EXPECT_EQ(rows[0],
              "file,x_mm,y_mm,theta_deg,x_grid,y_grid,section_u,section_v,profile,spacing_mm,"
              "px_per_spacing,preset,seed");
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> fields = split(rows[i], ',');
        ASSERT_EQ(fields.size(), 13u);
        EXPECT_EQ(file("frames/" + fields[0]).substr(0, 15), "P5\n188 120\n255\n");
        EXPECT_NEAR(std::stod(fields[1]), std::stod(fields[4]) * 0.508, 1e-6);
        EXPECT_EQ(fields[11], "hard");
        EXPECT_EQ(fields[12], "5");
    }
}

TEST_F(SimulateCommand, EqualOptionsGiveEqualBytesAndAFrameDoesNotDependOnTheOthers) {
    ASSERT_EQ(run("-o few --frames 2"), 0);
    ASSERT_EQ(run("-o many --frames 20"), 0);
    for (const char* name : {"/frame_000000.pgm", "/frame_000001.pgm"}) {
        EXPECT_EQ(file(std::string("few") + name), file(std::string("many") + name));
    }
}

TEST_F(SimulateCommand, OptionsFixWhatIsOtherwiseDrawn) {
    ASSERT_EQ(run("-o frames --frames 3 --at 5000.25,7000.5 --angle 200 --section 3,4 --size 64x80 "
                  "--code published --spacing 0.6 --mm-per-px 0.05"),
              0)
        << errors_;
    const std::string expected =
        ",3000.1500000,4200.3000000,-160.000000000,5000.25000000,7000.50000000,3,4,libdots,0.6,"
        "12,nominal,1";
    for (int i = 0; i < 3; ++i) {
        const std::string name = "frame_00000" + std::to_string(i) + ".pgm";
        EXPECT_EQ(truth_rows("frames")[static_cast<std::size_t>(i + 1)], name + expected);
        EXPECT_EQ(file("frames/" + name).substr(0, 13), "P5\n64 80\n255\n");
    }
}

TEST_F(SimulateCommand, AForeignSceneHasNoPose) {
    ASSERT_EQ(run("-o frames --frames 1 --scene plain_grid"), 0);
    EXPECT_THAT(truth_rows("frames")[1], HasSubstr("frame_000000.pgm,,,,,,,,anoto,"));
}

TEST_F(SimulateCommand, WrongUsageIsNamed) {
    EXPECT_EQ(run("-o frames --size 188"), 2);
    EXPECT_THAT(errors_, HasSubstr("188x120"));
    EXPECT_EQ(run("-o frames --preset nice"), 2);
    EXPECT_THAT(errors_, HasSubstr("clean, nominal or hard"));
    EXPECT_EQ(run("-o frames --at 500000000,1"), 2);
    EXPECT_EQ(run("-o frames --missing 2"), 2);
    EXPECT_EQ(run("-o /proc/nowhere"), 1);
    EXPECT_THAT(errors_, HasSubstr("/proc/nowhere"));
}

}  // namespace
}  // namespace dotpose::test
