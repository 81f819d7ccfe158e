/// Draws ink on sub-pixels in bands of sub-rows.
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
        int width = 0;  ///< sub-pixels per row of whole pixels, with the border
        int band_rows = 0;
    };

    Raster(const Ink& ink, const Layout& layout);

    /// Draws the sub-rows `top` to `top + band_rows - 1`, numbered from the top of the border. Call
    /// `take_row` for all rows of the previous band first.
    void draw_band(int top);

    /// The sub-pixels of one pixel in a sub-row.
    struct Spot {
        std::size_t pixel = 0;  ///< numbered from the left of the border
        /// Fraction of the light that the ink absorbs in each sub-pixel; zero from index
        /// Layout::per_pixel.
        std::array<float, Kernel::kMaxPerPixel> darkness{};
    };

    /// Returns the pixels with ink in a row of the band, without duplicates, and clears the row.
    std::span<const Spot> take_row(int row_in_band);

  private:
    // Sub-pixel coordinates: sub-pixel i covers [i, i + 1).
    struct Ellipse {
        double x, y;
        double slant;       // change of the x of a chord's middle per y
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
    double tallest_ = 0;             // largest half_height
    std::vector<Polygon> polygons_;
    int band_top_ = 0;
    // Most sub-pixels have no ink; only the sub-pixels in `spans_` of their row are read.
    struct Span {
        int from, to;
    };
    float* row(int row_in_band);
    std::vector<float> band_;
    std::vector<std::vector<Span>> spans_;  // may overlap
    std::vector<double> coverage_;          // covered fractions in the current row
    Span touched_{};                        // the non-zero part of coverage_
    std::vector<Spot> spots_;
};

}  // namespace dotpose::simulate
