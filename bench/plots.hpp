/// Draws the pictures of docs/speed.md.
#pragma once

#include <iosfwd>
#include <vector>

#include "benchmarks.hpp"

namespace dotpose::bench {

/// Draws times over the number of pixels.
void draw_pixels(std::ostream& out, const std::vector<FrameTimes>& times);
/// Draws times over the number of dots, in frames of one size.
void draw_dots(std::ostream& out, const std::vector<FrameTimes>& times);

}  // namespace dotpose::bench
