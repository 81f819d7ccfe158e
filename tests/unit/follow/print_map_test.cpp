// Tests maps of simulated prints, and fixes that are corrected by these maps.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../mapped_print.hpp"

namespace dotpose::test {
namespace {

/// Side length of the page. The page is so small that each dot is in several of the kFrames frames.
constexpr double kSide_mm = 30;
constexpr int kFrames = 100;

/// The map of a print with jitter and a feed wave. It is computed once for all tests.
class PrintMapping : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        print_ = new MappedPrint({.side_mm = kSide_mm});
        map_ = new PrintMapResult(map_of(*print_, kFrames));
    }
    static void TearDownTestSuite() {
        delete map_;
        delete print_;
    }
    static MappedPrint* print_;
    static PrintMapResult* map_;
};
MappedPrint* PrintMapping::print_ = nullptr;
PrintMapResult* PrintMapping::map_ = nullptr;

TEST_F(PrintMapping, FindsTheJitterOfThePrint) {
    ASSERT_EQ(map_->pages.size(), 1U);
    const MappedPage& page = map_->pages[0];
    EXPECT_EQ(page.frames, std::size_t{kFrames});
    EXPECT_GT(page.seen, page.dots * 9 / 10);
    EXPECT_NEAR(page.jitter_mm, print_->options().jitter_mm, 0.0005);
    EXPECT_TRUE(page.is_rigid);
}

TEST_F(PrintMapping, KeepsOffsetScaleAndTurnOfThePage) {
    const MapPage& page = map_->map.pages[0];
    double sum_x = 0;
    double sum_y = 0;
    double along = 0;
    double across = 0;
    for (int j = 0; j < page.rows; ++j) {
        for (int i = 0; i < page.columns; ++i) {
            const auto dot = static_cast<std::size_t>(j * page.columns + i);
            if (page.views[dot] == 0) continue;
            const DotOffset& offset = page.offsets[dot];
            const double x = i - (page.columns - 1) / 2.0;
            const double y = j - (page.rows - 1) / 2.0;
            sum_x += offset.x();
            sum_y += offset.y();
            along += x * offset.x() + y * offset.y();
            across += x * offset.y() - y * offset.x();
        }
    }
    const auto dots = static_cast<double>(page.columns * page.rows);
    EXPECT_NEAR(sum_x / dots, 0, 1e-5);
    EXPECT_NEAR(sum_y / dots, 0, 1e-5);
    EXPECT_NEAR(along / dots, 0, 1e-4);
    EXPECT_NEAR(across / dots, 0, 1e-4);
}

TEST_F(PrintMapping, CorrectsFramesThatWereNotUsed) {
    const MapTest test = test_map(*print_, map_->map, 40);
    EXPECT_EQ(test.used, 40);
    EXPECT_LE(test.with.absolute_um(), test.without.absolute_um() / 5);
    EXPECT_LE(test.with.absolute_um(), 0.2);
    const double ratio = test.with.absolute_um() / test.with.sigma_um();
    EXPECT_LT(ratio * ratio, 1.5);
    EXPECT_GT(ratio * ratio, 0.6);
}

TEST_F(PrintMapping, TheCovarianceContainsTheErrorOfTheMap) {
    PrintMap exact = map_->map;
    MapPage& page = exact.pages[0];
    page.errors = {};
    const MapTest with = test_map(*print_, map_->map, 10);
    const MapTest without = test_map(*print_, exact, 10);
    const double um = 1000 * page.spacing_mm;
    double largest = 0;
    for (const MapErrors::Node& node : map_->map.pages[0].errors.nodes)
        largest = std::max(largest, um * std::sqrt(double(node[0])));
    const double added = std::pow(with.with.sigma_um(), 2) - std::pow(without.with.sigma_um(), 2);
    EXPECT_GT(added, 0);
    EXPECT_LT(added, largest * largest);
    EXPECT_EQ(with.with.absolute_um(), without.with.absolute_um());
    // The map is less accurate at the edges of the page, where no test frame has its centre.
    const double mean = std::pow(1000 * map_->pages[0].error_mm, 2);
    EXPECT_GT(mean, added);
    EXPECT_LT(mean, 16 * added);
}

TEST_F(PrintMapping, AnotherPrintContradictsTheMap) {
    const MappedPrint other({.side_mm = kSide_mm, .print = 2});
    const MapTest test = test_map(other, map_->map, 20);
    EXPECT_EQ(test.used, 0);
    EXPECT_EQ(test.contradicted, 20);
    EXPECT_EQ(test.with.absolute_um(), test.without.absolute_um());
}

TEST_F(PrintMapping, RefusesToUpdateTheMapOfAnotherPrint) {
    const MappedPrint other({.side_mm = kSide_mm, .print = 2});
    EXPECT_THAT(
        [&] { (void)map_of(other, 20, 300, map_->map); },
        ::testing::ThrowsMessage<Error>(::testing::HasSubstr("contradict the earlier map")));
}

TEST_F(PrintMapping, AnUpdateAddsViewsAndKeepsThePlace) {
    const PrintMapResult updated = map_of(*print_, 60, 400, map_->map);
    const MapPage& before = map_->map.pages[0];
    const MapPage& after = updated.map.pages[0];
    EXPECT_EQ(after.frames, before.frames + 60);
    long views_before = 0;
    long views_after = 0;
    for (std::size_t i = 0; i < before.views.size(); ++i) {
        views_before += before.views[i];
        views_after += after.views[i];
    }
    EXPECT_GT(views_after, views_before * 5 / 4);
    // The slowly varying errors of the earlier map remain.
    EXPECT_GE(updated.pages[0].error_mm, map_->pages[0].error_mm);
    const MapTest test = test_map(*print_, updated.map, 40);
    EXPECT_LE(test.with.absolute_um(), test.without.absolute_um() / 5);
}

TEST_F(PrintMapping, UsesTheViewOfACameraFile) {
    Camera camera;
    camera.width_px = print_->options().width_px;
    camera.height_px = print_->options().height_px;
    camera.centre_px = {(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    const double mm_per_px = CameraModel{}.mm_per_px;
    camera.paper = PaperScale{mm_per_px, mm_per_px, 0, 0, 0};
    const MapTest test = test_map(*print_, map_->map, 40, 200, camera);
    EXPECT_EQ(test.used, 40);
    EXPECT_LE(test.with.absolute_um(), test.without.absolute_um() / 5);
    EXPECT_LE(test.with.absolute_um(), 0.2);
}

/// The tracked attempt measures each dot in a small window at its nominal position. This biases the
/// measured centres of dots with jitter towards their nominal positions. Nevertheless, fixes in a
/// sequence must be as accurate as fixes from single images.
TEST_F(PrintMapping, FollowsAsExactlyAsItLocates) {
    FollowerOptions options;
    options.sheets = {print_->entry()};
    options.print_map = map_->map;
    Follower follower(options);
    Follower single(options);
    const double um = 1000 * print_->entry().sheet.pattern.spacing_mm;
    constexpr int kTests = 40;
    double squares = 0;
    for (int i = 0; i < kTests; ++i) {
        const double way_mm = 0.25 * i;
        const GreyImage image = print_->frame({{10 + way_mm, 12 + way_mm / 2}, 0.3 + 0.01 * i},
                                              scramble(static_cast<std::uint64_t>(700 + i)));
        const Located followed = follower.follow(image.view(), i * 5000).located;
        const Located located = single.locate(image);
        ASSERT_EQ(followed.map_use, MapUse::used);
        squares += std::pow(um * (followed.fix.x_grid() - located.fix.x_grid()), 2) +
                   std::pow(um * (followed.fix.y_grid() - located.fix.y_grid()), 2);
    }
    EXPECT_LT(std::sqrt(squares / (2 * kTests)), 0.02);
}

TEST_F(PrintMapping, RefusesSheetsWithoutThePageOfTheMap) {
    FollowerOptions options;
    options.sheets = {print_->entry()};
    options.print_map = map_->map;
    Follower follower(options);
    SheetEntry other = print_->entry();
    other.sheet.origin.x += 1000;
    EXPECT_THAT([&] { follower.set_sheets({other}); },
                ::testing::ThrowsMessage<Error>(::testing::HasSubstr("the print map is of page")));
    EXPECT_EQ(follower.sheets().front().sheet.origin, print_->entry().sheet.origin);
    follower.set_sheets({other, print_->entry()});
    EXPECT_EQ(follower.sheets().size(), 2U);
}

TEST_F(PrintMapping, ConvergesInFewIterations) {
    const MappedPrint large({.side_mm = 60});
    // Without a preconditioner for deformations of the whole page, the first rounds would need
    // hundreds of iterations.
    EXPECT_LT(map_of(large, 200).pages[0].iterations, 120);
}

/// The map of a print without jitter reduces the residuals of a frame only slightly, but moves its
/// fix by micrometres.
TEST(PrintMapOfAPrintWithoutJitter, IsUsed) {
    const MappedPrint print({.side_mm = kSide_mm, .jitter_mm = 0});
    const MapTest test = test_map(print, map_of(print, kFrames).map, 20);
    EXPECT_EQ(test.used, 20);
    EXPECT_LE(test.with.absolute_um(), test.without.absolute_um() / 5);
}

/// If the print has no feed wave, the mean offset of the map is correct to 0.2 µm.
TEST(PrintMapOfAPrintWithoutWave, CorrectsPosesInSpace) {
    const MappedPrint print({.side_mm = kSide_mm, .wave_mm = 0});
    const CameraModel model;
    Camera camera;
    camera.width_px = print.options().width_px;
    camera.height_px = print.options().height_px;
    camera.centre_px = {(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    camera.focal_px = model.working_distance_mm / model.mm_per_px;
    FollowerOptions options;
    options.sheets = {print.entry()};
    options.camera = camera;
    options.fits_space_pose = true;
    Follower plain(options);
    options.print_map = map_of(print, kFrames).map;
    Follower mapped(options);
    const Cell origin = print.entry().sheet.origin;
    const double mm = print.entry().sheet.pattern.spacing_mm;
    double without = 0;
    double with = 0;
    double variance = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const MappedPrint::Pose pose = print.pose(600, i);
        const GreyImage image = print.frame(pose, scramble(600 + i));
        const auto error2 = [&](const Located& located) {
            const CameraInSpace& at = located.space->camera;
            return std::pow(at.x_mm - origin.x * mm - pose.at_mm.x, 2) +
                   std::pow(at.y_mm - origin.y * mm - pose.at_mm.y, 2);
        };
        const Located before = plain.locate(image);
        const Located after = mapped.locate(image);
        ASSERT_TRUE(before.space && after.space);
        EXPECT_EQ(after.map_use, MapUse::used);
        without += error2(before);
        with += error2(after);
        variance += after.space->covariance[0][0] + after.space->covariance[1][1];
    }
    // The camera is 16 mm above the page, so a tilt error also displaces the camera position.
    EXPECT_LT(with, without / 9);
    EXPECT_LT(with, 4 * variance);
}

TEST(PrintMapOfFewFrames, IsRefused) {
    const MappedPrint print({.side_mm = kSide_mm});
    EXPECT_THAT([&] { (void)map_of(print, 5); },
                ::testing::ThrowsMessage<Error>(::testing::HasSubstr("no page was seen in 10")));
}

}  // namespace
}  // namespace dotpose::test
