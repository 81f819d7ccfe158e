// Tests the pose that is fitted to a tracked frame. The true pose is the affine map that displaced
// the dots.
#include "device/tracked_pose.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "device/predicted.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::tracked_pose_test {
namespace {

using namespace core;

/// The sums over the tracked dots of a frame of 188 x 120 px. The grid has a spacing of 11 px, and
/// is rotated about the image centre. `add` adds a dot with a given offset from its cell.
struct Frame {
    explicit Frame(double angle_rad) {
        const double along = 11 * 65536 * std::cos(angle_rad);
        const double across = 11 * 65536 * std::sin(angle_rad);
        const auto rounded = [](double value) {
            return static_cast<std::int32_t>(std::lround(value));
        };
        tracking.width_px = 188;
        tracking.height_px = 120;
        tracking.first_cell = 4;
        tracking.last_cell = 27;
        tracking.grid_rows = rows;
        tracking.cells.along_x_q16 = {rounded(along), rounded(across)};
        tracking.cells.along_y_q16 = {rounded(-across), rounded(along)};
        tracking.cells.origin_q16 = {rounded(93.5 * 65536 - 16.25 * along + 15.75 * across),
                                     rounded(59.5 * 65536 - 16.25 * across - 15.75 * along)};
        tracking.displacement_q12 = 4096 / 6;
        set_displacement(4096 / 6, tracking);
    }
    /// Adds a dot with an offset of (x_px, y_px) to the sums of its row.
    void add(int i, int j, int symbol, std::int32_t mass, double x_px, double y_px) {
        TrackedRow& row = rows[static_cast<std::size_t>(j)];
        const FixedVec off{static_cast<std::int32_t>(std::lround(x_px * 256 * mass)),
                           static_cast<std::int32_t>(std::lround(y_px * 256 * mass))};
        const int from_middle = i - 16;
        row.mass += mass;
        row.mass_i += mass * from_middle;
        row.mass_ii += mass * from_middle * from_middle;
        row.offset_q8 = {row.offset_q8.x + off.x, row.offset_q8.y + off.y};
        row.offset_i_q8 = {row.offset_i_q8.x + from_middle * off.x,
                           row.offset_i_q8.y + from_middle * off.y};
        FixedVec& of_symbol = tracking.offset_q8[static_cast<std::size_t>(symbol)];
        of_symbol = {of_symbol.x + off.x, of_symbol.y + off.y};
        ++tracking.dots_measured;
    }

    Tracking tracking;
    std::array<TrackedRow, kMaxComparedLines> rows{};
};

double at(std::int32_t origin, std::int32_t x, std::int32_t y, double i, double j) {
    return (origin + i * x + j * y) / 65536.0;
}

TEST(TrackedPose, GoesThroughTheDots) {
    Rng rng(3);
    for (int round = 0; round < 50; ++round) {
        Frame frame(rng.uniform(-0.8, 0.8));
        const double x0 = rng.uniform(-0.5, 0.5);
        const double xi = rng.uniform(-0.03, 0.03);
        const double xj = rng.uniform(-0.03, 0.03);
        const double y0 = rng.uniform(-0.5, 0.5);
        const double yi = rng.uniform(-0.03, 0.03);
        const double yj = rng.uniform(-0.03, 0.03);
        // The mass of the dots increases by a factor of 1.45 from left to right. Uneven light has
        // the same effect. It must not change the fit.
        const std::int32_t mass = round % 2 == 0 ? 1000 : 60;
        for (int j = 10; j <= 21; ++j) {
            for (int i = 9; i <= 24; ++i) {
                const int symbol = static_cast<int>(rng.below(4));
                frame.add(i, j, symbol, mass + mass * i / 24, x0 + xi * (i - 16) + xj * (j - 16),
                          y0 + yi * (i - 16) + yj * (j - 16));
            }
        }
        PlaneFromImage plane{};
        std::int32_t displacement_q16 = 0;
        EXPECT_EQ(fit_tracked_pose(frame.tracking, plane, displacement_q16), 12 * 16);
        const CellMap& cells = frame.tracking.cells;
        for (const auto& [i, j] : {std::array{9.0, 10.0}, {24.0, 21.0}, {16.0, 16.0}}) {
            const double x_px =
                at(cells.origin_q16.x, cells.along_x_q16.x, cells.along_y_q16.x, i, j) + x0 +
                xi * (i - 16) + xj * (j - 16) - 93.5;
            const double y_px =
                at(cells.origin_q16.y, cells.along_x_q16.y, cells.along_y_q16.y, i, j) + y0 +
                yi * (i - 16) + yj * (j - 16) - 59.5;
            const double found_i = plane.at_centre_q16.x / 65536.0 +
                                   (plane.du_q24.x * x_px + plane.dv_q24.x * y_px) / (1 << 24);
            const double found_j = plane.at_centre_q16.y / 65536.0 +
                                   (plane.du_q24.y * x_px + plane.dv_q24.y * y_px) / (1 << 24);
            EXPECT_NEAR(found_i, i, 3e-4) << round;
            EXPECT_NEAR(found_j, j, 3e-4) << round;
        }
    }
}

TEST(TrackedPose, TellsHowFarDotsAreDisplaced) {
    Frame frame(0.3);
    for (int j = 10; j <= 21; ++j) {
        for (int i = 9; i <= 24; ++i) {
            const int symbol = (i + 2 * j) % 4;
            const FixedVec displaced_q16 =
                frame.tracking.displaced_q16[static_cast<std::size_t>(symbol)];
            frame.add(i, j, symbol, 300, 0.05 * displaced_q16.x / 65536,
                      0.05 * displaced_q16.y / 65536);
        }
    }
    PlaneFromImage plane{};
    std::int32_t displacement_q16 = 0;
    EXPECT_EQ(fit_tracked_pose(frame.tracking, plane, displacement_q16), 12 * 16);
    EXPECT_NEAR(displacement_q16, 1.05 * 65536 / 6, 60);
}

TEST(TrackedPose, IsNoneWithoutDotsOrOfDotsOnALine) {
    Frame frame(0.1);
    PlaneFromImage plane{};
    std::int32_t displacement_q16 = 0;
    EXPECT_EQ(fit_tracked_pose(frame.tracking, plane, displacement_q16), 0);
    for (int i = 9; i <= 24; ++i)
        frame.add(i, 12, i % 4, 300, 0.1, 0.1);
    EXPECT_EQ(fit_tracked_pose(frame.tracking, plane, displacement_q16), 0);
}

}  // namespace
}  // namespace dotpose::core_test::tracked_pose_test
