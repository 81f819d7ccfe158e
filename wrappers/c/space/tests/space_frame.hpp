/// A frame from a tilted camera, and the C objects that locate it.
#pragma once

#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "../../../../tests/tilted_shot.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose_space.h"

namespace dotpose {

using test::kTilt_rad;
inline constexpr double kDistance_mm = test::kTiltedDistance_mm;

struct Destroy {
    void operator()(dotpose_locator* locator) const { dotpose_locator_destroy(locator); }
};
using CLocator = std::unique_ptr<dotpose_locator, Destroy>;

/// A frame from a camera that is tilted by 20 degrees towards +x.
class SpaceInC : public testing::Test {
  protected:
    void SetUp() override {
        shot_ = test::tilted_shot();
        focal_px_ = test::focal_px_of(shot_);
        image_ = render(shot_);
        ASSERT_EQ(dotpose_space_camera_init(&camera_, sizeof camera_, 320, 240, focal_px_),
                  DOTPOSE_OK);
        ASSERT_EQ(dotpose_space_pose_init(&pose_, sizeof pose_), DOTPOSE_OK);
        locator_ = make_locator(true);
    }

    CLocator make_locator(bool for_space, int kind = DOTPOSE_KIND_LARGE) {
        dotpose_options options;
        dotpose_options_init(&options, sizeof options);
        options.code = DOTPOSE_CODE_ANOTO;
        if (for_space) {
            EXPECT_EQ(dotpose_space_use_camera(&camera_, &options), DOTPOSE_OK);
        }
        dotpose_locator* locator = nullptr;
        EXPECT_EQ(dotpose_locator_create(kind, &options, &locator), DOTPOSE_OK);
        return CLocator(locator);
    }

    dotpose_status locate(dotpose_locator* locator, const GreyImage& image) {
        dotpose_fix fix;
        dotpose_fix_init(&fix, sizeof fix);
        return dotpose_locate(locator, image.pixels.data(), image.width_px, image.height_px,
                              image.width_px, nullptr, &fix);
    }
    dotpose_status fit(const dotpose_locator* locator) {
        return dotpose_space_fit(locator, &camera_, image_.pixels.data(), 320, 240, 320, &pose_);
    }

    /// Writes the frame as a PGM.
    void write_frame(const std::string& path) const {
        std::ofstream(path, std::ios::binary)
            << "P5\n320 240\n255\n"
            << std::string(image_.pixels.begin(), image_.pixels.end());
    }

    Shot shot_;
    GreyImage image_;
    double focal_px_ = 0;
    dotpose_space_camera camera_;
    dotpose_space_pose pose_;
    CLocator locator_;
};

}  // namespace dotpose
