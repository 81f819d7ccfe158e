// Border dots: finds the dots whose darkest pixels are so close to the border of the image that
// `find_fine_dots` cannot measure them. In small frames, up to a quarter of the dots are this close
// to the border.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Finds the dots whose darkest pixels are in the two outermost columns or rows on any side of the
/// image, and adds them to `Tracking::found`. All rows of the image must be stored. The centre of a
/// dot on the border may be wrong by up to a quarter of a pixel, but its bits can still be read.
void find_border_dots(Tracking& tracking);

}  // namespace dotpose::core
