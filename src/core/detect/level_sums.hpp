// Level sums: sums of grey levels over pixel boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "dotpose/geometry.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// A rectangle of pixels. All bounds are inclusive.
struct PixelBox {
    int left;
    int right;
    int top;
    int bottom;

    /// Constructs the box that extends `half_px` in all directions from the pixel nearest to a
    /// point, clipped to the image.
    PixelBox(const ImageView& image, FixedVec point_q8, int half_px) {
        const int u = (point_q8.x + 128) >> 8;
        const int v = (point_q8.y + 128) >> 8;
        left = std::max(u - half_px, 0);
        right = std::min(u + half_px, image.width_px - 1);
        top = std::max(v - half_px, 0);
        bottom = std::min(v + half_px, image.height_px - 1);
    }
    int columns() const { return std::max(right - left + 1, 0); }
    int rows() const { return std::max(bottom - top + 1, 0); }
    int pixels() const { return columns() * rows(); }
};

/// A summed-area table of grey levels (Crow 1984), which gives the sum over any box within its
/// area.
class LevelSums {
  public:
    static constexpr int kMaxSide_px = 48;

    /// Builds the table for the area `all`, which may have up to kMaxSide_px rows and columns.
    LevelSums(const ImageView& image, const PixelBox& all) : left_(all.left), top_(all.top) {
        std::fill_n(sums_[0].begin(), all.columns() + 1, 0U);
        for (int j = 0; j < all.rows(); ++j) {
            const std::uint8_t* pixels = image.row(all.top + j) + all.left;
            const auto& above = sums_[static_cast<std::size_t>(j)];
            auto& below = sums_[static_cast<std::size_t>(j) + 1];
            std::uint32_t row_sum = below[0] = 0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(all.columns()); ++i) {
                row_sum += pixels[i];
                below[i + 1] = above[i + 1] + row_sum;
            }
        }
    }
    /// Returns the sum of the grey levels in a non-empty box within the area of the table.
    int of(const PixelBox& box) const {
        return static_cast<int>(at(box.right + 1, box.bottom + 1) - at(box.left, box.bottom + 1) -
                                at(box.right + 1, box.top) + at(box.left, box.top));
    }

  private:
    std::uint32_t at(int u, int v) const {
        return sums_[static_cast<std::size_t>(v - top_)][static_cast<std::size_t>(u - left_)];
    }

    int left_;
    int top_;
    std::array<std::array<std::uint32_t, kMaxSide_px + 1>, kMaxSide_px + 1> sums_;
};

}  // namespace dotpose::core
