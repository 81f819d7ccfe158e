// Derotate: removes the rotation of the scene from a rolling-shutter image.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/readout_turn.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Returns the image that the camera would see if the scene did not rotate during the readout. The
/// scene keeps the orientation that it had when the middle row was read. Levels between pixels are
/// interpolated linearly, and border pixels replace pixels outside the image. `memory` receives the
/// pixels, and must have one byte per pixel.
ImageView derotated(const ImageView& image, const ReadoutTurn& turn,
                    std::span<std::uint8_t> memory);

}  // namespace dotpose::core
