/// Renders a sheet at a printer's resolution, one pixel row at a time.
#pragma once

#include "dotpose/tools/print.hpp"
#include "png/png.hpp"

namespace dotpose::print {

struct RasterSize {
    int width_px = 0;
    int height_px = 0;
};

/// Returns the size of the page in printer pixels, rounded to whole pixels.
RasterSize raster_size(const Sheet& sheet, double dpi);

/// Calls `sink` for each pixel row from top to bottom. The sheet and the resolution must be valid.
/// At any time, only the pixel rows of one row of dots are in memory.
void rasterize(const Sheet& sheet, double dpi, const Progress& progress, const png::RowSink& sink);

}  // namespace dotpose::print
