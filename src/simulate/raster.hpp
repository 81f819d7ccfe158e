/// Draws ink on sub-pixels, one band of sub-rows at a time.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulate/ink.hpp"
#include "simulate/kernel.hpp"

namespace dotpose::simulate {

class Raster {
  public:
    struct Layout {
        int per_pixel = 1;
        int border_px = 0;
        /// Number of sub-pixels per row, including the border. It is a multiple of `per_pixel`.
        int width = 0;
        int band_rows = 0;
    };

    Raster(const Ink& ink, const Layout& layout);

    /// Draws the sub-rows `top` to `top + band_rows - 1`, where sub-row 0 is the top of the border.
    /// All rows of the previous band must have been taken with `take_row`.
    void draw_band(int top);

    /// The sub-pixels of one pixel in one sub-row.
    struct Spot {
        std::size_t pixel = 0;  ///< index in the row, including the border
        /// Fraction of the light that the ink absorbs in each sub-pixel. Only the first
        /// Layout::per_pixel elements are used. The others are 0.
        std::array<float, Kernel::kMaxPerPixel> darkness{};
    };

    /// Returns the pixels with ink in a row of the band, without duplicates, and clears the row.
    /// The result is valid until the next call.
    std::span<const Spot> take_row(int row_in_band);

  private:
    // An ellipse in sub-pixel coordinates, in which sub-pixel i extends from i to i + 1.
    struct Ellipse {
        double x, y;
        double slant;       // horizontal shift of the chord midpoints per unit of y
        double half_width;  // half the length of the chord through the centre
        double half_height;
        double darkness;  // 1 - reflectance
    };
    struct Polygon {
        std::vector<Vec2> corners;
        double top, bottom;
        double darkness;
    };

    template <typename ChordAt>
    void fill(double top, double bottom, double darkness, const ChordAt& chord_at);
    void cover(double left, double right, double weight);

    Layout layout_;
    std::vector<Ellipse> ellipses_;  // sorted by y
    double max_half_height_ = 0;     // maximum half height of the ellipses
    std::vector<Polygon> polygons_;
    int band_top_ = 0;
    // A range of sub-pixels with ink. Most sub-pixels have no ink, so only these ranges are read.
    struct Span {
        int from, to;
    };
    float* row(int row_in_band);
    std::vector<float> band_;
    std::vector<std::vector<Span>> spans_;  // spans of each row in the band, possibly overlapping
    std::vector<double> coverage_;          // covered fraction of each sub-pixel in the current row
    Span touched_{};                        // range of non-zero elements of coverage_
    std::vector<Spot> spots_;
};

}  // namespace dotpose::simulate
