/// Simulates bare paper with its texture under uneven light.
#pragma once

#include <vector>

#include "simulate/ink.hpp"

namespace dotpose::simulate {

/// Returns the grey level of bare paper in each pixel, row by row, for the frame and a border of
/// `border_px` around it. The level is assumed to be constant over a pixel, because light and
/// texture change by less than 1 % between adjacent pixels.
std::vector<float> bare_paper(const View& view, const Page& page,
                              const Imperfections& imperfections, int border_px);

}  // namespace dotpose::simulate
