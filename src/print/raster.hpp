/// The pixels of a sheet at a printer's resolution, one pixel row at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {

struct RasterSize {
    int width_px = 0;
    int height_px = 0;
};

/// The page in whole printer pixels, nearest to its size in mm.
RasterSize raster_size(const Sheet& sheet, double dpi);

/// Takes one pixel row: 8 pixels per byte, leftmost in the highest bit, 1 is ink.
using RowSink = std::function<void(std::span<const std::uint8_t>)>;

/// Hands all pixel rows to `sink`, top to bottom. The sheet and resolution must be validated.
/// Holds the rows that one row of dots covers, no more.
void rasterize(const Sheet& sheet, double dpi, const Progress& progress, const RowSink& sink);

}  // namespace dotpose::print
