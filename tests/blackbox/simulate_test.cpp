// Black-box tests of `dotpose simulate`.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sheets_command.hpp"

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
              "file,x_mm,y_mm,theta_deg,x_grid,y_grid,section_u,section_v,code,spacing_mm,"
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
                  "--code libdots --spacing 0.6 --mm-per-px 0.05"),
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
    EXPECT_THAT(errors_, HasSubstr("clean, nominal, hard or mouse"));
    EXPECT_EQ(run("-o frames --at 500000000,1"), 2);
    EXPECT_EQ(run("-o frames --missing 2"), 2);
    EXPECT_EQ(run("-o /proc/nowhere"), 1);
    EXPECT_THAT(errors_, HasSubstr("/proc/nowhere"));
}

std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

TEST_F(SimulateCommand, NoFrameOfAnEarlierRunIsLeft) {
    ASSERT_EQ(run("-o frames --frames 5"), 0);
    std::ofstream(directory_ / "frames/notes.txt") << "mine";
    ASSERT_EQ(run("-o frames --frames 2 --seed 9"), 0);
    EXPECT_THAT(errors_, HasSubstr("removed 5 frames of an earlier run"));
    EXPECT_THAT(
        names_in(directory_ / "frames"),
        testing::ElementsAre("frame_000000.pgm", "frame_000001.pgm", "notes.txt", "truth.csv"));
    EXPECT_EQ(ToolCommand::run("evaluate frames"), 0) << errors_;
}

TEST_F(SimulateCommand, FramesOfACameraAreNotTouched) {
    fs::create_directory(directory_ / "frames");
    std::ofstream(directory_ / "frames/frame_000007.pgm") << "of a camera";
    EXPECT_EQ(run("-o frames --frames 2"), 1);
    EXPECT_THAT(errors_, HasSubstr("frame_000007.pgm: name another folder"));
    EXPECT_THAT(names_in(directory_ / "frames"), testing::ElementsAre("frame_000007.pgm"));
}

class SimulateDrive : public SheetsCommand {
  protected:
    int simulate(const std::string& arguments) {
        return ToolCommand::run("simulate --drive --sheets sheets.json --preset clean " +
                                arguments);
    }
};

TEST_F(SimulateDrive, RunsOverTheSeamOfTwoSheets) {
    // The second page is to the right of the first page, rotated by 90 degrees.
    ASSERT_EQ(print("-o a.svg --paper 60x40 --sheets sheets.json --name a"), 0) << errors_;
    ASSERT_EQ(print("-o b.svg --paper 40x60 --sheets sheets.json --name b"), 0) << errors_;
    ASSERT_EQ(ToolCommand::run("sheets place a --x 0 --y 0 --yaw 0"), 0);
    ASSERT_EQ(ToolCommand::run("sheets place b --x 60 --y -40 --yaw 90"), 0);
    ASSERT_EQ(simulate("-o frames --speed 200 --fps 10"), 0) << errors_;
    ASSERT_EQ(ToolCommand::run("locate --sheets sheets.json frames"), 0) << errors_;
    const std::vector<json> found = records();
    ASSERT_GT(found.size(), 8U);
    std::set<std::string> sheets;
    std::vector<double> steps_mm;
    std::optional<json> last;
    int between_sheets = 0;
    for (const json& record : found) {
        // Where the path crosses the margins of both pages, the camera may see no dots.
        if (record["status"] != "ok") {
            ++between_sheets;
            last.reset();
            continue;
        }
        sheets.insert(record["sheet"]);
        // The sheets span 120 x 40 mm. The figure eight keeps a distance of 5 mm plus half the
        // diagonal of the camera's view (about 5 mm) from the outer edges, so x is between about 10
        // and 110 mm.
        EXPECT_GT(record["x_m"], 0.0095);
        EXPECT_LT(record["x_m"], 0.1105);
        if (last) {
            steps_mm.push_back(
                1000 * std::hypot(record["x_m"].get<double>() - (*last)["x_m"].get<double>(),
                                  record["y_m"].get<double>() - (*last)["y_m"].get<double>()));
        }
        last = record;
    }
    EXPECT_LE(between_sheets, 2);
    EXPECT_THAT(sheets, testing::ElementsAre("a", "b"));
    // Consecutive frames are 20 mm apart along the path. In curves, the straight-line distance
    // between them is shorter.
    for (const double step_mm : steps_mm) {
        EXPECT_LT(step_mm, 20.1);
        EXPECT_GT(step_mm, 12);
    }
    ASSERT_EQ(ToolCommand::run("evaluate frames --format json"), 0) << errors_;
    const json score = json::parse(output_);
    EXPECT_EQ(score["frames"], found.size());
    EXPECT_EQ(score["wrong"], 0);
    EXPECT_LT(score["position_um"]["max"], 10);
}

TEST_F(SimulateDrive, MakesAVideoWithItsTruth) {
    ASSERT_EQ(print("-o a.svg --paper 80x60 --sheets sheets.json --name a"), 0) << errors_;
    ASSERT_EQ(simulate("-o drive.avi --frames 6 --size 320x240 --fps 25"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("drive.avi: 6 frames of 320 x 240 px"));
    ASSERT_EQ(ToolCommand::run("evaluate drive.avi --poses drive-truth.csv --format json"), 0)
        << errors_;
    const json score = json::parse(output_);
    EXPECT_EQ(score["frames"], 6);
    EXPECT_EQ(score["located"], 6);
    EXPECT_EQ(score["wrong"], 0);
    EXPECT_EQ(ToolCommand::run("simulate -o odd.avi --size 189x120"), 1);
    EXPECT_THAT(errors_, HasSubstr("even sizes"));
}

TEST_F(SimulateDrive, NeedsASheet) {
    EXPECT_EQ(ToolCommand::run("simulate -o frames --drive"), 2);
    EXPECT_EQ(simulate("-o frames --at 1,2"), 2);
    write("sheets.json", R"({"version": 1, "sheets": []})");
    EXPECT_NE(simulate("-o frames"), 0);
}

}  // namespace
}  // namespace dotpose::test
