/// Bare paper in its light.
#pragma once

#include <vector>

#include "simulate/ink.hpp"

namespace dotpose::simulate {

/// Grey level of bare paper in each pixel of the frame and of `border_px` pixels around it, row by
/// row. Constant over a pixel: light and texture change by less than 1 % from one to the next.
std::vector<float> bare_paper(const View& view, const Page& page,
                              const Imperfections& imperfections, int border_px);

}  // namespace dotpose::simulate
