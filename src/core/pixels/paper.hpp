// Paper: its grey level all over the image, under dots and graphics as well.
#pragma once

#include "dotpose/image.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Measures the paper in blocks of a tenth of the shorter side: the level that a third of their
/// pixels exceed.
void measure_paper(const ImageView& image, PaperMap& map);

/// The brightest paper of a pixel's block and the eight around it.
int brightest_paper_near(const PaperMap& map, int u, int v);

/// The paper at a pixel: that of its block, unless graphics cover most of it. Outside the image
/// that of the nearest block.
int paper_at(const PaperMap& map, int u, int v);

}  // namespace dotpose::core
