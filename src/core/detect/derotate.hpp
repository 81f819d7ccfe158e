// Derotate: removes the rotation of the scene during the readout of a rolling shutter from an
// image.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/readout_turn.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Returns the image of a scene that does not rotate, at the time of the middle row. Interpolates
/// linearly between pixels. Pixels that the image does not contain are copied from its border.
/// Writes the pixels to `memory`, which must have a byte per pixel.
ImageView derotated(const ImageView& image, const ReadoutTurn& turn,
                    std::span<std::uint8_t> memory);

}  // namespace dotpose::core
