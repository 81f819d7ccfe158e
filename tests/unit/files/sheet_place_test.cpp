#include "dotpose/files/sheet_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace dotpose {
namespace {

constexpr double kPi = std::numbers::pi;

/// Returns a sheet of 20 x 10 cells with a spacing of 0.5 mm. The first cell is at (4, 3) mm from
/// the corner of the page, so the last cell is at (13.5, 7.5) mm. The right and bottom margins are
/// 6.5 mm and 2.5 mm wide.
SheetEntry small_entry(Cell origin) {
    SheetEntry entry;
    entry.name = "small";
    entry.sheet.pattern.spacing_mm = 0.5;
    entry.sheet.pattern.section = {10, 20};
    entry.sheet.origin = origin;
    entry.sheet.columns = 20;
    entry.sheet.rows = 10;
    entry.sheet.width_mm = 20;
    entry.sheet.height_mm = 10;
    entry.sheet.origin_x_mm = 4;
    entry.sheet.origin_y_mm = 3;
    return entry;
}

Fix fix_at(Cell cell, double fraction_x = 0, double fraction_y = 0, double theta_rad = 0) {
    Fix fix;
    fix.status = Status::ok;
    fix.cell = cell;
    fix.fraction_x_q16 = static_cast<std::uint16_t>(fraction_x * 65536);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(fraction_y * 65536);
    fix.theta_bam = static_cast<std::int32_t>(theta_rad / kPi * 2147483648.0);
    fix.section = {10, 20};
    return fix;
}

TEST(find_sheet, tells_the_place_on_the_page) {
    const std::vector<SheetEntry> sheets = {small_entry({1000, 2000}), small_entry({9000, 2000})};
    const auto first = find_sheet(sheets, CodeVariant::anoto, fix_at({1000, 2000}));
    ASSERT_TRUE(first);
    EXPECT_EQ(first->entry, &sheets[0]);
    EXPECT_EQ(first->x_mm, 4);
    EXPECT_EQ(first->y_mm, 3);
    const auto inside =
        find_sheet(sheets, CodeVariant::anoto, fix_at({9011, 2003}, 0.5, 0.25, 1.25));
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->entry, &sheets[1]);
    EXPECT_NEAR(inside->x_mm, 4 + 11.5 * 0.5, 1e-12);
    EXPECT_NEAR(inside->y_mm, 3 + 3.25 * 0.5, 1e-12);
    EXPECT_NEAR(inside->theta_rad, 1.25, 1e-8);
}

TEST(find_sheet, margins_belong_to_the_page_and_nothing_beyond_its_edges) {
    const std::vector<SheetEntry> sheets = {small_entry({1000, 2000})};
    // Relative to the first intersection, the page extends 8 cells to the left, 6 up, 32 to the
    // right and 14 down.
    const auto is_found = [&](Cell cell, double fraction_x = 0, double fraction_y = 0) {
        return find_sheet(sheets, CodeVariant::anoto, fix_at(cell, fraction_x, fraction_y))
            .has_value();
    };
    EXPECT_TRUE(is_found({992, 2004}));
    EXPECT_FALSE(is_found({991, 2004}, 0.99));
    EXPECT_TRUE(is_found({1004, 1994}));
    EXPECT_FALSE(is_found({1004, 1993}, 0, 0.99));
    EXPECT_TRUE(is_found({1032, 2004}));
    EXPECT_FALSE(is_found({1032, 2004}, 0.01));
    EXPECT_TRUE(is_found({1004, 2014}));
    EXPECT_FALSE(is_found({1004, 2014}, 0, 0.01));
    EXPECT_FALSE(is_found({0, 0}));
    EXPECT_FALSE(is_found({1004 + kPositionsPerAxis / 2, 2004}));
}

TEST(find_sheet, a_margin_gives_way_to_the_neighbours_own_region) {
    // The second region begins at the end of the first, as on a poster of several pages.
    const std::vector<SheetEntry> sheets = {small_entry({1000, 2000}), small_entry({1020, 2000})};
    const auto entry_at = [&](Cell cell, double fraction_x) {
        const auto place = find_sheet(sheets, CodeVariant::anoto, fix_at(cell, fraction_x));
        return place ? place->entry : nullptr;
    };
    EXPECT_EQ(entry_at({1018, 2000}, 0), &sheets[0]);
    EXPECT_EQ(entry_at({1019, 2000}, 0.49), &sheets[0]);
    EXPECT_EQ(entry_at({1019, 2000}, 0.51), &sheets[1]);
    EXPECT_EQ(entry_at({1020, 2000}, 0), &sheets[1]);
}

TEST(find_sheet, the_margin_of_a_sheet_at_the_plane_s_corner_has_the_last_cells) {
    const std::vector<SheetEntry> sheets = {small_entry({0, 0})};
    // The place is three columns to the left of the first cell and three rows above it, where the
    // pattern continues in another section.
    const Place place = moved(CodeVariant::anoto, {{0, 0}, {10, 20}}, -3, -3);
    ASSERT_EQ(place.cell, (Cell{kPositionsPerAxis - 3, kPositionsPerAxis - 3}));
    Fix fix = fix_at(place.cell, 0.5, 0);
    fix.section = place.section;
    const auto found = find_sheet(sheets, CodeVariant::anoto, fix);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x_mm, 4 - 2.5 * 0.5, 1e-12);
    EXPECT_NEAR(found->y_mm, 3 - 3 * 0.5, 1e-12);
}

TEST(find_sheet, wants_a_fix_in_the_same_section_and_profile) {
    const std::vector<SheetEntry> sheets = {small_entry({1000, 2000})};
    Fix fix = fix_at({1004, 2004});
    EXPECT_TRUE(find_sheet(sheets, CodeVariant::anoto, fix));
    EXPECT_FALSE(find_sheet(sheets, CodeVariant::libdots, fix));
    EXPECT_FALSE(find_sheet({}, CodeVariant::anoto, fix));
    fix.section.u = 11;
    EXPECT_FALSE(find_sheet(sheets, CodeVariant::anoto, fix));
    fix.section = {10, 21};
    EXPECT_FALSE(find_sheet(sheets, CodeVariant::anoto, fix));
    fix.section = {10, 20};
    fix.status = Status::not_certain;
    EXPECT_FALSE(find_sheet(sheets, CodeVariant::anoto, fix));
}

TEST(find_sheet, applies_the_print_scale_about_the_first_intersection) {
    std::vector<SheetEntry> sheets = {small_entry({1000, 2000})};
    sheets[0].print_scale_x = 1.02;
    sheets[0].print_scale_y = 0.99;
    const auto place = find_sheet(sheets, CodeVariant::anoto, fix_at({1010, 2008}, 0, 0, kPi / 4));
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x_mm, 4 + 5.1, 1e-12);
    EXPECT_NEAR(place->y_mm, 3 + 3.96, 1e-12);
    // On the paper, a nominal square is 1.02 wide and 0.99 high, which changes the angle of its
    // diagonal.
    EXPECT_NEAR(std::tan(place->theta_rad), 0.99 / 1.02, 1e-8);
}

TEST(world_place, flips_y_and_turns_counter_clockwise) {
    SheetEntry entry = small_entry({1000, 2000});
    SheetPlace place{&entry, 100, 200, 0};
    EXPECT_FALSE(world_place(place));

    // The page is not rotated. The place is 100 mm to the right of the corner, and 200 mm below it.
    entry.world = {5, 7, 0};
    auto pose = world_place(place);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->x_m, 5.1, 1e-12);
    EXPECT_NEAR(pose->y_m, 6.8, 1e-12);
    EXPECT_NEAR(pose->yaw_rad, 0, 1e-12);

    // The upper edge is along the world's y axis, so right on the page is +y in the world, and down
    // on the page is +x.
    entry.world->yaw_rad = kPi / 2;
    pose = world_place(place);
    EXPECT_NEAR(pose->x_m, 5.2, 1e-12);
    EXPECT_NEAR(pose->y_m, 7.1, 1e-12);
    EXPECT_NEAR(pose->yaw_rad, kPi / 2, 1e-12);

    // The image is rotated clockwise by 30 degrees on the page.
    place.theta_rad = kPi / 6;
    EXPECT_NEAR(world_place(place)->yaw_rad, kPi / 3, 1e-12);
}

TEST(world_place, is_that_of_complex_numbers) {
    SheetEntry entry = small_entry({1000, 2000});
    for (const double yaw_rad : {-3.0, -0.4, 1.1, 40.0}) {
        for (const double theta_rad : {-3.1, 0.2, 3.1}) {
            entry.world = {-2, 0.5, yaw_rad};
            const auto pose = world_place({&entry, 123, 45, theta_rad});
            ASSERT_TRUE(pose);
            const std::complex<double> turn = std::polar(1.0, yaw_rad);
            const std::complex<double> at =
                std::complex(-2.0, 0.5) + turn * std::conj(std::complex(0.123, 0.045));
            EXPECT_NEAR(pose->x_m, at.real(), 1e-12);
            EXPECT_NEAR(pose->y_m, at.imag(), 1e-12);
            EXPECT_NEAR(pose->yaw_rad, std::arg(turn * std::polar(1.0, -theta_rad)), 1e-12);
        }
    }
}

TEST(world_place, half_a_turn_is_positive) {
    SheetEntry entry = small_entry({1000, 2000});
    entry.world = {0, 0, -kPi};
    EXPECT_EQ(world_place({&entry, 0, 0, 0})->yaw_rad, kPi);
}

/// Returns a fix with a covariance in which no element is zero.
Fix uncertain_fix() {
    Fix fix = fix_at({1010, 2003}, 0.5, 0.25, 0.7);
    constexpr float kCovariance[3][3] = {
        {4e-6F, -1e-6F, 3e-7F}, {-1e-6F, 9e-6F, -5e-7F}, {3e-7F, -5e-7F, 1e-6F}};
    std::copy(&kCovariance[0][0], &kCovariance[0][0] + 9, &fix.covariance[0][0]);
    return fix;
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// Returns J C J^T. Column k of J is the derivative of the pose with respect to coordinate k of the
/// fix, in spacings or radians. J is computed from central differences, so the test does not depend
/// on formulas for the derivatives.
template <typename PoseOf>
Matrix expected_covariance(const Fix& fix, const PoseOf& pose_of) {
    const auto moved_by = [&fix](std::size_t coordinate, double sign) {
        Fix moved = fix;
        const auto steps = static_cast<int>(sign * 4096);  // a sixteenth of a spacing
        if (coordinate == 0) moved.fraction_x_q16 = std::uint16_t(fix.fraction_x_q16 + steps);
        if (coordinate == 1) moved.fraction_y_q16 = std::uint16_t(fix.fraction_y_q16 + steps);
        if (coordinate == 2) moved.theta_bam += steps * 512;  // 3 mrad
        return moved;
    };
    Matrix jacobian{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Fix ahead = moved_by(k, 1);
        const Fix behind = moved_by(k, -1);
        const double step = k == 2 ? ahead.theta_rad() - behind.theta_rad() : 0.125;
        for (std::size_t i = 0; i < 3; ++i)
            jacobian[i][k] = (pose_of(ahead)[i] - pose_of(behind)[i]) / step;
    }
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 9; ++k) {
                result[i][j] +=
                    jacobian[i][k / 3] * double{fix.covariance[k / 3][k % 3]} * jacobian[j][k % 3];
            }
        }
    }
    return result;
}

void expect_near(const PoseCovariance& found, const Matrix& expected) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double scale = std::sqrt(expected[i][i] * expected[j][j]);
            EXPECT_NEAR(double{found[i][j]} / scale, expected[i][j] / scale, 1e-5) << i << j;
        }
    }
}

TEST(covariance_on_a_sheet, is_what_small_movements_say) {
    const Fix fix = uncertain_fix();
    for (const auto& [x_scale, y_scale] : {std::pair(1.0, 1.0), std::pair(0.8, 1.3)}) {
        SheetEntry entry = small_entry({1000, 2000});
        entry.print_scale_x = x_scale;
        entry.print_scale_y = y_scale;
        const std::vector sheets = {entry};
        const auto place_of = [&](const Fix& moved) {
            return find_sheet(sheets, CodeVariant::anoto, moved).value();
        };
        const auto expected = expected_covariance(fix, [&](const Fix& moved) {
            const SheetPlace place = place_of(moved);
            return std::array{place.x_mm, place.y_mm, place.theta_rad};
        });
        expect_near(place_of(fix).covariance, expected);
    }
}

TEST(covariance_in_the_world, is_what_small_movements_say) {
    const Fix fix = uncertain_fix();
    for (const double yaw_rad : {0.0, 0.4, -2.0, std::numbers::pi}) {
        SheetEntry entry = small_entry({1000, 2000});
        entry.print_scale_x = 1.2;
        entry.print_scale_y = 0.9;
        entry.world = {-2, 0.5, yaw_rad};
        const std::vector sheets = {entry};
        const auto place_of = [&](const Fix& moved) {
            return world_place(find_sheet(sheets, CodeVariant::anoto, moved).value()).value();
        };
        const auto expected = expected_covariance(fix, [&](const Fix& moved) {
            const WorldPlace place = place_of(moved);
            // Angles are relative to the angle of the fix, to avoid a jump at half a turn.
            const double yaw =
                std::remainder(place.yaw_rad - place_of(fix).yaw_rad, 2 * std::numbers::pi);
            return std::array{place.x_m, place.y_m, yaw};
        });
        expect_near(place_of(fix).covariance, expected);
    }
}

TEST(covariance_in_the_world, of_a_page_turned_by_a_quarter) {
    // On this page, x points along the world's y axis and y along the world's x axis, so angles
    // change sign.
    const PoseCovariance on_sheet = {{{1, 2, 3}, {2, 5, 6}, {3, 6, 9}}};
    const PoseCovariance in_world = world_covariance(on_sheet, kPi / 2);
    const Matrix expected = {{{5, 2, -6}, {2, 1, -3}, {-6, -3, 9}}};
    expect_near(in_world, expected);
}

TEST(covariance_on_a_sheet, is_none_if_the_fix_has_none) {
    const std::vector sheets = {small_entry({1000, 2000})};
    const auto place = find_sheet(sheets, CodeVariant::anoto, fix_at({1010, 2003}));
    EXPECT_EQ(place.value().covariance, PoseCovariance{});
}

}  // namespace
}  // namespace dotpose
