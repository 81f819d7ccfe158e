/// The pictures of docs/speed.md.
#pragma once

#include <iosfwd>
#include <vector>

#include "benchmarks.hpp"

namespace dotpose::bench {

/// Time against pixels.
void draw_pixels(std::ostream& out, const std::vector<FrameTimes>& times);
/// Time against dots, in frames of one size.
void draw_dots(std::ostream& out, const std::vector<FrameTimes>& times);

}  // namespace dotpose::bench
