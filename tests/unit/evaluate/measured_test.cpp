#include "dotpose/tools/measured.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "../../xml_check.hpp"

namespace dotpose {
namespace {

using testing::HasSubstr;

constexpr double kTurn_rad = 0.3;
constexpr double kScale = 1.002;
constexpr double kOffset_rad = 1.1;

/// Returns frames at the points of a grid. The located positions are the grid points, with errors
/// of up to 1 µm per axis. The true positions are the grid points after a rotation, a scaling, and
/// a shift by (5, -7) mm.
std::vector<MeasuredFrame> frames() {
    std::vector<MeasuredFrame> result;
    for (int i = 0; i < 25; ++i) {
        const double x = 10.0 * (i % 5);
        const double y = 10.0 * (i / 5);
        const double c = kScale * std::cos(kTurn_rad);
        const double s = kScale * std::sin(kTurn_rad);
        const double angle_rad = 0.25 * i;
        MeasuredFrame frame;
        frame.file = "frame" + std::to_string(i);
        frame.truth =
            TruePlace{false, "table", 5 + c * x - s * y, -7 + s * x + c * y,
                      std::remainder(angle_rad + kTurn_rad + kOffset_rad, 2 * std::numbers::pi)};
        frame.found = FoundPlace{"table", x + 0.001 * (i % 3 - 1), y + 0.001 * (i % 2), angle_rad};
        result.push_back(frame);
    }
    return result;
}

TEST(Measured, AlignsByASimilarityInSpiteOfOutliers) {
    std::vector<MeasuredFrame> all = frames();
    std::swap(all[3].truth, all[20].truth);  // as if two lines of the pose file were swapped
    const Similarity by = align(all);
    EXPECT_NEAR(by.scale, kScale, 1e-4);
    EXPECT_NEAR(by.turn_rad, kTurn_rad, 1e-4);
    EXPECT_NEAR(by.angle_offset_rad, kOffset_rad, 1e-5);
    const Measurement result = compare(all, by);
    EXPECT_EQ(result.located, 23);
    EXPECT_EQ(result.wrong, 2);
    EXPECT_TRUE(result.errors[3]->is_wrong);
    EXPECT_TRUE(result.errors[20]->is_wrong);
    EXPECT_LT(result.position_um.max, 2);
    EXPECT_LT(result.angle_deg.max, 1e-3);
}

TEST(Measured, ComparesPlacesAsTheyAreWithoutAlignment) {
    std::vector<MeasuredFrame> all(3);
    for (int i = 0; i < 3; ++i) {
        all[static_cast<std::size_t>(i)].truth = TruePlace{true, "", 100.0 * i, 50, 0.5};
        all[static_cast<std::size_t>(i)].found = FoundPlace{"a", 100.0 * i + 0.03, 50.04, 0.5};
    }
    const Measurement result = compare(all, std::nullopt);
    EXPECT_EQ(result.located, 3);
    EXPECT_NEAR(result.position_um.median, 50, 1e-6);
    EXPECT_NEAR(result.x_um.bias, 30, 1e-6);
    EXPECT_NEAR(result.y_um.bias, 40, 1e-6);
    EXPECT_NEAR(result.x_um.sigma, 0, 1e-6);
}

TEST(Measured, OneSpotDeterminesTheShiftOnly) {
    std::vector<MeasuredFrame> all(4);
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].truth = TruePlace{false, "", 20, 30, std::nullopt};
        all[i].found = FoundPlace{"a", 20.5 + (i % 2 == 0 ? 0.001 : -0.001), 30, 0.1};
    }
    const Similarity by = align(all);
    EXPECT_EQ(by.scale, 1);
    EXPECT_EQ(by.turn_rad, 0);
    EXPECT_NEAR(by.shift_x_mm, -0.5, 1e-9);
    EXPECT_NEAR(compare(all, by).position_um.max, 1, 1e-6);
}

TEST(Measured, AFixOnAnotherSheetOrOnNoneIsWrong) {
    std::vector<MeasuredFrame> all = frames();
    all[0].found->sheet = "other";
    all[1].found.reset();
    all[2].found.reset();
    all[2].status = Status::no_grid;
    const Measurement result = compare(all, align(all));
    EXPECT_EQ(result.wrong, 2);
    EXPECT_EQ(result.located, 22);
    EXPECT_THAT(described(result), testing::Contains(testing::Pair("not located: no_grid", "1")));
    std::ostringstream csv;
    write_errors_csv(csv, result);
    EXPECT_THAT(csv.str(), HasSubstr("\nframe2,no_grid,,"));
    EXPECT_THROW(align(std::vector<MeasuredFrame>(3)), Error);
}

TEST(Measured, IsDrawnAsInThePaper) {
    const std::vector<MeasuredFrame> all = frames();
    const test::TemporaryDirectory directory;
    write_measurement(directory.path(), compare(all, align(all)));
    for (const char* name : {"figure-13", "figure-14", "figure-15"}) {
        std::ostringstream svg;
        svg << std::ifstream(directory.path() / (std::string(name) + ".svg")).rdbuf();
        EXPECT_EQ(test::XmlCheck(svg.str()).problem(), "");
        EXPECT_THAT(svg.str(), HasSubstr("at rest, measured"));
        EXPECT_TRUE(std::filesystem::exists(directory.path() / (std::string(name) + ".png")));
    }
    EXPECT_TRUE(std::filesystem::exists(directory.path() / "positions.csv"));
    EXPECT_TRUE(std::filesystem::exists(directory.path() / "angles.csv"));
}

}  // namespace
}  // namespace dotpose
