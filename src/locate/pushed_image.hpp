// Pushed image: collects the rows that are pushed to a Locator.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// An image that is pushed to a Locator row by row.
struct PushedImage {
    std::span<std::uint8_t> memory;
    int width_px = 0;
    int height_px = 0;
    int rows = 0;  ///< number of rows pushed so far
    bool has_prediction = false;
    Prediction prediction;

    /// Starts an image. Returns false if the image does not fit in the memory.
    bool begin(int width, int height) {
        width_px = width;
        height_px = height;
        rows = 0;
        has_prediction = false;
        return size(height) <= memory.size();
    }
    void add_row(const std::uint8_t* pixels) {
        std::copy_n(pixels, width_px, memory.begin() + static_cast<std::ptrdiff_t>(size(rows)));
        ++rows;
    }
    /// Returns the image. Missing rows are white.
    ImageView completed() const {
        const std::size_t begin = size(rows);
        std::fill_n(memory.begin() + static_cast<std::ptrdiff_t>(begin), size(height_px) - begin,
                    std::uint8_t{255});
        return {memory.data(), width_px, height_px, width_px};
    }

  private:
    std::size_t size(int height) const {
        return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height);
    }
};

}  // namespace dotpose::core
