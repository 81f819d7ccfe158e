#include "draw/embedded_image.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "dotpose/tools/grey_image.hpp"
#include "png/png.hpp"

namespace dotpose::draw {
namespace {

/// Returns a reduced image in which each pixel is the mean of a block of `by` x `by` pixels. Blocks
/// at the right and lower edges may be smaller. Grey levels are rounded to multiples of 4, because
/// noise in the lowest bits does not compress.
GreyImage reduced(ImageView image, int by) {
    GreyImage result{{}, (image.width_px + by - 1) / by, (image.height_px + by - 1) / by};
    for (int v = 0; v < image.height_px; v += by) {
        for (int u = 0; u < image.width_px; u += by) {
            const int right = std::min(u + by, image.width_px);
            const int bottom = std::min(v + by, image.height_px);
            int sum = 0;
            for (int row = v; row < bottom; ++row)
                sum += std::accumulate(image.row(row) + u, image.row(row) + right, 0);
            const int mean = sum / ((right - u) * (bottom - v));
            result.pixels.push_back(static_cast<std::uint8_t>(std::min((mean + 2) / 4 * 4, 255)));
        }
    }
    return result;
}

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t n) {
            return i + n < bytes.size() ? std::uint32_t{bytes[i + n]} : 0U;
        };
        const std::uint32_t group = byte(0) << 16 | byte(1) << 8 | byte(2);
        text += kDigits[group >> 18];
        text += kDigits[(group >> 12) & 63];
        text += i + 1 < bytes.size() ? kDigits[(group >> 6) & 63] : '=';
        text += i + 2 < bytes.size() ? kDigits[group & 63] : '=';
    }
    return text;
}

}  // namespace

std::string data_uri(ImageView image, int max_side_px) {
    if (image.pixels == nullptr || image.width_px <= 0 || image.height_px <= 0) return {};
    const int side_px = std::max(image.width_px, image.height_px);
    const int by = (side_px + max_side_px - 1) / max_side_px;
    if (by == 1) return "data:image/png;base64," + base64(png::encode(image));
    return "data:image/png;base64," + base64(png::encode(reduced(image, by).view()));
}

}  // namespace dotpose::draw
