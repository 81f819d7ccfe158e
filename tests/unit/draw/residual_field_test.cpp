#include <gtest/gtest.h>

#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"

namespace dotpose {
namespace {

TEST(ResidualField, SumsTheResidualsOfEachPart) {
    LensCalibration calibration;
    calibration.camera.width_px = 220;
    calibration.camera.height_px = 105;
    calibration.seen = {{0, {0, 0}, {1, 2}, {0.1, 0.2}},
                        {1, {9.4, 9.4}, {3, 4}, {0.3, 0.4}},
                        {1, {219, 104}, {5, 6}, {-0.5, 0.6}}};
    const ResidualField field = residual_field(calibration);
    EXPECT_EQ(field.columns, 22);
    EXPECT_EQ(field.rows, 11);
    EXPECT_DOUBLE_EQ(field.part_px, 10);
    ASSERT_EQ(field.parts.size(), 22U * 11);
    EXPECT_EQ(field.parts[0].dots, 2);
    EXPECT_DOUBLE_EQ(field.parts[0].before.u, 4);
    EXPECT_DOUBLE_EQ(field.parts[0].before.v, 6);
    EXPECT_DOUBLE_EQ(field.parts[0].after.u, 0.4);
    EXPECT_EQ(field.parts.back().dots, 1);
    EXPECT_DOUBLE_EQ(field.parts.back().after.v, 0.6);
    EXPECT_EQ(field.parts[1].dots, 0);
}

}  // namespace
}  // namespace dotpose
