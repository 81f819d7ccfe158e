// Tests the C functions for print maps, with maps that contain known offsets.
#include "dotpose/files/print_map.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "../../../../tests/shell.hpp"
#include "../../../../tests/temporary_directory.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose_print_map.h"
#include "space_frame.hpp"

namespace dotpose {
namespace {

constexpr std::int16_t kOffset_q14 = 1024;  ///< a sixteenth of a spacing

struct DestroyMap {
    void operator()(dotpose_print_map* map) const { dotpose_print_map_destroy(map); }
};
using CMap = std::unique_ptr<dotpose_print_map, DestroyMap>;

class PrintMapInC : public SpaceInC {
  protected:
    void SetUp() override {
        SpaceInC::SetUp();
        ASSERT_EQ(dotpose_fix_init(&fix_, sizeof fix_), DOTPOSE_OK);
    }

    /// Returns the contents of a map file for the page in view. In the map, all dots are displaced
    /// along x. The noise stored in the map is set high, so the map is accepted although the print
    /// does not have these displacements.
    std::string displaced_map() const {
        PrintMap map;
        MapPage& page = map.pages.emplace_back();
        page.name = "page";
        page.section = shot_.page.pattern.section;
        page.origin = {shot_.pose.cell.x - 100, shot_.pose.cell.y - 100};
        page.columns = page.rows = 200;
        page.spacing_mm = shot_.page.pattern.spacing_mm;
        page.frames = 10;
        page.noise = 0.1;
        page.offsets.assign(200 * 200, {kOffset_q14, 0});
        page.views.assign(200 * 200, 10);
        return print_map_bytes(map);
    }

    static CMap read(const std::string& bytes) {
        dotpose_print_map* map = nullptr;
        EXPECT_EQ(dotpose_print_map_create(bytes.data(), bytes.size(), &map), DOTPOSE_OK);
        return CMap(map);
    }
    dotpose_status correct(const CMap& map) {
        return dotpose_print_map_correct(map.get(), locator_.get(), &fix_, &use_);
    }
    dotpose_status fit_mapped(const CMap& map) {
        return dotpose_print_map_fit_space(map.get(), locator_.get(), &camera_,
                                           image_.pixels.data(), 320, 240, 320, &pose_, &use_);
    }

    dotpose_fix fix_;
    dotpose_map_use use_ = -1;
    const double offset_mm_ = kDefaultSpacing_mm * kOffset_q14 / 16384;
};

TEST_F(PrintMapInC, MovesFixesByTheOffsets) {
    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    ASSERT_EQ(correct(read(displaced_map())), DOTPOSE_OK);
    EXPECT_EQ(use_, DOTPOSE_MAP_USED);
    EXPECT_NEAR(fix_.x_mm, x_grid(shot_.pose) * kDefaultSpacing_mm + offset_mm_, 0.01);
    EXPECT_NEAR(fix_.y_mm, y_grid(shot_.pose) * kDefaultSpacing_mm, 0.01);
    EXPECT_GT(fix_.covariance[0], 0);
}

TEST_F(PrintMapInC, MovesPosesInSpaceByTheOffsets) {
    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    ASSERT_EQ(fit(locator_.get()), DOTPOSE_OK);
    const dotpose_space_pose without = pose_;
    ASSERT_EQ(fit_mapped(read(displaced_map())), DOTPOSE_OK);
    EXPECT_EQ(use_, DOTPOSE_MAP_USED);
    EXPECT_NEAR(pose_.x_mm, without.x_mm + offset_mm_, 0.005);
    EXPECT_NEAR(pose_.y_mm, without.y_mm, 0.005);
    EXPECT_NEAR(pose_.z_mm, without.z_mm, 0.005);
}

TEST_F(PrintMapInC, ReportsWhyAMapIsNotUsed) {
    PrintMap map = parse_print_map(displaced_map());
    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    ASSERT_EQ(fit(locator_.get()), DOTPOSE_OK);
    const double x_mm = pose_.x_mm;
    MapPage& page = map.pages.front();
    Rng rng(4);
    for (DotOffset& offset : page.offsets)
        offset.x_q14 = static_cast<std::int16_t>(rng.uniform(-1500, 1500));
    page.noise = 0.001;
    ASSERT_EQ(fit_mapped(read(print_map_bytes(map))), DOTPOSE_OK);
    EXPECT_EQ(use_, DOTPOSE_MAP_CONTRADICTED);
    EXPECT_EQ(pose_.x_mm, x_mm);
    page.views.assign(page.views.size(), 0);
    ASSERT_EQ(correct(read(print_map_bytes(map))), DOTPOSE_OK);
    EXPECT_EQ(use_, DOTPOSE_MAP_NOT_COVERED);
    EXPECT_NEAR(fix_.x_mm, x_grid(shot_.pose) * kDefaultSpacing_mm, 0.01);
    page.origin.x += 1000;
    ASSERT_EQ(correct(read(print_map_bytes(map))), DOTPOSE_OK);
    EXPECT_EQ(use_, DOTPOSE_MAP_NONE);
}

TEST_F(PrintMapInC, IsUsedByACProgram) {
    const test::TemporaryDirectory folder;
    const std::string frame = (folder.path() / "frame.pgm").string();
    const std::string map = (folder.path() / "page.map").string();
    write_frame(frame);
    std::ofstream(map, std::ios::binary) << displaced_map();
    const test::ShellOutcome run =
        test::run_shell("'" DOTPOSE_MAPPED_PEN "' " + std::to_string(focal_px_) + ' ' +
                        std::to_string(kDistance_mm) + " '" + map + "' '" + frame + "' 2>&1");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    double x_mm = 0;
    double y_mm = 0;
    double height_mm = 0;
    int is_down = 0;
    int use = 0;
    ASSERT_EQ(std::sscanf(run.output.c_str(), "tip_mm %lf %lf height_mm %lf down %d map %d", &x_mm,
                          &y_mm, &height_mm, &is_down, &use),
              5);
    EXPECT_NEAR(x_mm, x_grid(shot_.pose) * kDefaultSpacing_mm + offset_mm_, 0.01);
    EXPECT_NEAR(y_mm, y_grid(shot_.pose) * kDefaultSpacing_mm, 0.01);
    EXPECT_NEAR(height_mm, 0, 0.03);
    EXPECT_EQ(is_down, 1);
    EXPECT_EQ(use, DOTPOSE_MAP_USED);
}

TEST_F(PrintMapInC, RefusesMisuse) {
    const std::string bytes = displaced_map();
    dotpose_print_map* none = nullptr;
    EXPECT_EQ(dotpose_print_map_create(bytes.data(), bytes.size() - 1, &none), DOTPOSE_BAD_VALUE);
    EXPECT_EQ(none, nullptr);
    EXPECT_EQ(dotpose_print_map_create("", 0, &none), DOTPOSE_BAD_VALUE);
    EXPECT_EQ(dotpose_print_map_create(nullptr, 0, &none), DOTPOSE_NULL_POINTER);
    EXPECT_EQ(dotpose_print_map_create(bytes.data(), bytes.size(), nullptr), DOTPOSE_NULL_POINTER);
    dotpose_print_map_destroy(nullptr);
    const CMap map = read(bytes);
    EXPECT_EQ(correct(map), DOTPOSE_NO_FIX);  // no image was located
    EXPECT_EQ(fit_mapped(map), DOTPOSE_NO_FIX);
    EXPECT_EQ(correct(CMap()), DOTPOSE_NULL_POINTER);
    EXPECT_EQ(fit_mapped(CMap()), DOTPOSE_NULL_POINTER);
    fix_.size = 8;
    EXPECT_EQ(correct(map), DOTPOSE_BAD_SIZE);
    locator_ = make_locator(false);
    EXPECT_EQ(correct(map), DOTPOSE_WRONG_KIND);
    EXPECT_EQ(use_, -1);
}

}  // namespace
}  // namespace dotpose
