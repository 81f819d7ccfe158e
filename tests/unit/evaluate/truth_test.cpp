#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "dotpose/tools/evaluate.hpp"

namespace dotpose {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TruthFile : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "dotpose-truth-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
    }
    void TearDown() override { fs::remove_all(directory_); }

    std::vector<TruthRow> read(const std::string& content,
                               std::optional<double> spacing_mm = std::nullopt) const {
        std::ofstream(directory_ / "truth.csv", std::ios::binary) << content;
        return read_truth(directory_ / "truth.csv", spacing_mm);
    }
    std::string error_of(const std::string& content) const {
        try {
            read(content);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    }

    fs::path directory_;
};

TEST_F(TruthFile, HasPlacesOnSheetsOrInTheWorld) {
    const auto on_sheet = read(
        "file,sheet,x_sheet_mm,y_sheet_mm,theta_sheet_deg\n"
        "a.pgm,table,12.5,30,180\n"
        "b.pgm,,,,\n");
    EXPECT_FALSE(on_sheet[0].is_in_pattern);
    ASSERT_TRUE(on_sheet[0].place);
    EXPECT_FALSE(on_sheet[0].place->is_in_world);
    EXPECT_EQ(on_sheet[0].place->sheet, "table");
    EXPECT_EQ(on_sheet[0].place->x_mm, 12.5);
    EXPECT_NEAR(on_sheet[0].place->angle_rad.value(), std::numbers::pi, 1e-12);
    EXPECT_FALSE(on_sheet[1].place);
    // World poses take precedence over positions on sheets.
    const auto in_world = read("file,x_sheet_mm,y_sheet_mm,x_m,y_m\na.pgm,1,2,0.25,-0.5\n");
    EXPECT_TRUE(in_world[0].place->is_in_world);
    EXPECT_EQ(in_world[0].place->x_mm, 250);
    EXPECT_EQ(in_world[0].place->y_mm, -500);
    EXPECT_FALSE(in_world[0].place->angle_rad);
    EXPECT_NEAR(read("file,x_m,y_m,yaw_deg\na,1,2,90\n")[0].place->angle_rad.value(),
                std::numbers::pi / 2, 1e-12);
    EXPECT_THAT(error_of("file,x_m,y_sheet_mm\n"), HasSubstr("the header names no coordinates"));
}

TEST_F(TruthFile, IsReadAsSimulateWritesIt) {
    const auto rows = read(
        "file,x_mm,y_mm,theta_deg,x_grid,y_grid,section_u,section_v,code,spacing_mm,"
        "px_per_spacing,preset,seed\n"
        "a.pgm,50,100,90,100.5,200.25,3,62,microdots,0.5,11,hard,1\n"
        "b.pgm,,,,,,,,anoto,0.5,11,hard,1\n");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].file, "a.pgm");
    EXPECT_EQ(rows[0].code, CodeVariant::microdots);
    const Truth& truth = rows[0].truth;
    EXPECT_TRUE(truth.has_pose);
    EXPECT_EQ(truth.x_grid, 100.5);  // grid units take precedence over millimetres
    EXPECT_EQ(truth.y_grid, 200.25);
    EXPECT_NEAR(truth.theta_rad, std::numbers::pi / 2, 1e-12);
    EXPECT_EQ(truth.section, (Section{3, 62}));
    EXPECT_EQ(truth.spacing_mm, 0.5);
    EXPECT_FALSE(rows[1].truth.has_pose);
}

TEST_F(TruthFile, NeedsFewColumnsInAnyOrder) {
    const auto rows = read(
        "\xEF\xBB\xBFtheta_deg, y_mm ,x_mm,note,file\r\n"
        "-90,100,50,\"a, b\",\"fr\"\"1.png\"\r\n\r\n");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].file, "fr\"1.png");
    EXPECT_FALSE(rows[0].code);
    EXPECT_FALSE(rows[0].truth.section);
    EXPECT_NEAR(rows[0].truth.x_grid, 50 / 0.508, 1e-9);
    EXPECT_NEAR(rows[0].truth.y_grid, 100 / 0.508, 1e-9);
}

TEST_F(TruthFile, AGivenSpacingReplacesThatOfTheFile) {
    const auto rows = read("file,x_mm,y_mm,theta_deg,spacing_mm\na,50,100,0,0.25\n", 0.5);
    EXPECT_EQ(rows[0].truth.x_grid, 100);
    EXPECT_EQ(rows[0].truth.spacing_mm, 0.5);
}

TEST_F(TruthFile, ErrorsNameTheLineAndWhatIsWrong) {
    const std::string header = "file,x_grid,y_grid,theta_deg,section_u,section_v,code\n";
    EXPECT_THAT(error_of("file,x_grid,theta_deg\n"), HasSubstr("y_grid"));
    EXPECT_THAT(error_of("x_grid,y_grid,theta_deg\n"), HasSubstr("file"));
    EXPECT_THAT(error_of(header + "a,1,2,3,,,\nb,1,two,3,,,\n"),
                AllOf(HasSubstr("line 3"), HasSubstr("y_grid is 'two'")));
    EXPECT_THAT(error_of(header + "a,1,2\n"), HasSubstr("theta_deg is ''"));
    EXPECT_THAT(error_of(header + "a,1,nan,3,,,\n"), HasSubstr("'nan'"));
    EXPECT_THAT(error_of(header + "a,1,2,3,63,0,\n"), HasSubstr("section_u is 63"));
    EXPECT_THAT(error_of(header + "a,1,2,3,0,0,other\n"), HasSubstr("'other'"));
    EXPECT_THAT(error_of(header + ",1,2,3,0,0,\n"), HasSubstr("file is empty"));
    EXPECT_THAT(error_of(header), HasSubstr("no frames"));
    EXPECT_THAT(error_of(""), HasSubstr("is empty"));
}

TEST_F(TruthFile, ThatIsMissingOrAFolderIsAnError) {
    EXPECT_THROW(read_truth(directory_ / "none.csv"), Error);
    EXPECT_THROW(read_truth(directory_), Error);
}

TEST_F(TruthFile, FilesThatCannotBeReadAreAProblemOfTheirFrame) {
    const auto rows = read("file,x_grid,y_grid,theta_deg\nnone.pgm,1,2,3\n");
    EXPECT_THAT(frames_of_folder(directory_, rows)(0).problem, HasSubstr("none.pgm"));
}

}  // namespace
}  // namespace dotpose
