/// Simulates bare paper with its texture under uneven light.
#pragma once

#include <vector>

#include "simulate/ink.hpp"

namespace dotpose::simulate {

/// Returns the grey level of bare paper for each pixel of the frame and of a border that is
/// `border_px` wide, row by row. The level is assumed to be constant over a pixel, because light
/// and texture change by less than 1 % between adjacent pixels.
std::vector<float> bare_paper(const View& view, const Page& page,
                              const Imperfections& imperfections, int border_px);

}  // namespace dotpose::simulate
