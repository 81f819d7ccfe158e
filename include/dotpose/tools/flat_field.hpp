/// Corrects vignetting and uneven light with the flat field in a camera file.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/tools/grey_image.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Corrects the images of one camera. A Follower applies this correction if its camera has a flat
/// field.
///
///     const FlatFieldCorrection correction(camera);
///     for (;;) locator.locate(correction.corrected(image).view());
class FlatFieldCorrection {
  public:
    /// Computes the gain of each pixel from `camera.flat_field`. The flat field must not be empty,
    /// and `camera` must be valid (see `validate` in camera.hpp). The constructor does not check
    /// these conditions.
    explicit FlatFieldCorrection(const Camera& camera);

    /// Returns the image with each grey level divided by the flat field at its pixel. Levels are
    /// clamped to 255. Throws BadArgument if the image does not have the size given in the camera
    /// file.
    GreyImage corrected(ImageView image) const;

  private:
    int width_px_;
    int height_px_;
    std::vector<std::uint16_t> gains_q8_;  ///< gain of each pixel, row by row, in units of 2^-8
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
