#include "raw_image.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include <dotpose/files/error.hpp>

namespace dotpose_ros {
namespace {

/// The layout of a pixel in an encoding, and the weights that convert its samples to a grey level.
struct Encoding {
    const char* name;
    std::size_t samples;                   ///< number of samples per pixel
    std::size_t bytes;                     ///< bytes per sample
    std::array<std::uint32_t, 4> weights;  ///< weights of the samples, in thousandths
    bool is_bayer = false;
};

using Weights = std::array<std::uint32_t, 4>;
constexpr std::uint32_t kWhole = 1000;
constexpr Weights kFirst = {kWhole, 0, 0, 0};
constexpr Weights kSecond = {0, kWhole, 0, 0};
constexpr Weights kRgb = {299, 587, 114, 0};
constexpr Weights kBgr = {114, 587, 299, 0};

/// Planar encodings such as nv12 are treated as grey, because their first plane is the luma.
constexpr std::array kEncodings = {
    Encoding{"mono8", 1, 1, kFirst},
    Encoding{"8UC1", 1, 1, kFirst},
    Encoding{"mono16", 1, 2, kFirst},
    Encoding{"16UC1", 1, 2, kFirst},
    Encoding{"rgb8", 3, 1, kRgb},
    Encoding{"bgr8", 3, 1, kBgr},
    Encoding{"8UC3", 3, 1, kBgr},
    Encoding{"rgba8", 4, 1, kRgb},
    Encoding{"bgra8", 4, 1, kBgr},
    Encoding{"8UC4", 4, 1, kBgr},
    Encoding{"rgb16", 3, 2, kRgb},
    Encoding{"bgr16", 3, 2, kBgr},
    Encoding{"16UC3", 3, 2, kBgr},
    Encoding{"rgba16", 4, 2, kRgb},
    Encoding{"bgra16", 4, 2, kBgr},
    Encoding{"16UC4", 4, 2, kBgr},
    Encoding{"yuv422", 2, 1, kSecond},
    Encoding{"uyvy", 2, 1, kSecond},
    Encoding{"yuv422_yuy2", 2, 1, kFirst},
    Encoding{"yuyv", 2, 1, kFirst},
    Encoding{"nv12", 1, 1, kFirst},
    Encoding{"nv21", 1, 1, kFirst},
    Encoding{"nv24", 1, 1, kFirst},
    Encoding{"bayer_rggb8", 1, 1, kFirst, true},
    Encoding{"bayer_bggr8", 1, 1, kFirst, true},
    Encoding{"bayer_gbrg8", 1, 1, kFirst, true},
    Encoding{"bayer_grbg8", 1, 1, kFirst, true},
    Encoding{"bayer_rggb16", 1, 2, kFirst, true},
    Encoding{"bayer_bggr16", 1, 2, kFirst, true},
    Encoding{"bayer_gbrg16", 1, 2, kFirst, true},
    Encoding{"bayer_grbg16", 1, 2, kFirst, true},
};

const Encoding& encoding_of(const RawImage& image) {
    const auto found = std::ranges::find_if(
        kEncodings, [&](const Encoding& each) { return image.encoding == each.name; });
    if (found != kEncodings.end()) return *found;
    throw dotpose::Error("images are in the encoding '" + image.encoding +
                         "', which is not read: set the camera's driver to mono8, or to mono16, "
                         "rgb8, bgr8, yuv422, yuv422_yuy2, nv12 or a bayer encoding");
}

void require_size(const RawImage& image, const Encoding& encoding) {
    const std::size_t row = std::size_t{image.width} * encoding.samples * encoding.bytes;
    const std::size_t bytes = std::size_t{image.step} * image.height;
    if (row > 0 && image.step >= row && bytes > 0 && image.data.size() >= bytes) return;
    throw dotpose::Error("images of " + std::to_string(image.width) + " x " +
                         std::to_string(image.height) + " px in " + image.encoding +
                         " need a step of " + std::to_string(row) +
                         " bytes or more and all their rows; these have a step of " +
                         std::to_string(image.step) + " and " + std::to_string(image.data.size()) +
                         " bytes: correct width, height, step or encoding in the camera's driver");
}

/// Grey levels of an image, with up to 16 bits.
class Levels {
  public:
    Levels(const RawImage& image, const Encoding& encoding)
        : width_(image.width), height_(image.height), levels_(width_ * height_) {
        for (std::size_t v = 0; v < height_; ++v) {
            const std::uint8_t* sample = image.data.data() + v * image.step;
            for (std::size_t u = 0; u < width_; ++u)
                levels_[v * width_ + u] = level(sample, encoding, image.is_bigendian);
        }
    }

    /// Replaces each pixel with the weighted mean of 3 x 3 pixels, with the weights 1 2 1 along
    /// both axes. At every pixel of a mosaic, green pixels have half of the total weight, and red
    /// and blue pixels a quarter each.
    void mix_colours() {
        std::vector<std::uint16_t> mixed(levels_.size());
        for (std::size_t v = 0; v < height_; ++v) {
            const std::array rows = {beside(v, height_, -1), v, beside(v, height_, 1)};
            for (std::size_t u = 0; u < width_; ++u) {
                const std::array columns = {beside(u, width_, -1), u, beside(u, width_, 1)};
                std::size_t sum = 0;
                for (std::size_t i = 0; i < 3; ++i) {
                    for (std::size_t j = 0; j < 3; ++j)
                        sum += (1 + i % 2) * (1 + j % 2) * levels_[rows[i] * width_ + columns[j]];
                }
                mixed[v * width_ + u] = static_cast<std::uint16_t>((sum + 8) / 16);
            }
        }
        levels_ = std::move(mixed);
    }

    void put_into(dotpose::GreyImage& grey) const {
        const int bits = std::bit_width(std::ranges::max(levels_));
        const int shift = std::max(bits - 8, 0);
        grey.width_px = static_cast<int>(width_);
        grey.height_px = static_cast<int>(height_);
        grey.pixels.resize(levels_.size());
        std::ranges::transform(levels_, grey.pixels.begin(), [shift](std::uint16_t level) {
            return static_cast<std::uint8_t>(level >> shift);
        });
    }

  private:
    /// Returns the grey level of the pixel at `sample`, and advances `sample` to the next pixel.
    static std::uint16_t level(const std::uint8_t*& sample, const Encoding& encoding,
                               bool is_bigendian) {
        std::uint32_t sum = kWhole / 2;
        for (std::size_t i = 0; i < encoding.samples; ++i, sample += encoding.bytes) {
            const std::uint32_t value = encoding.bytes == 1 ? sample[0]
                                        : is_bigendian      ? sample[0] << 8 | sample[1]
                                                            : sample[1] << 8 | sample[0];
            sum += encoding.weights[i] * value;
        }
        return static_cast<std::uint16_t>(sum / kWhole);
    }

    /// Returns the index of the neighbour of `place` in the direction `step`, which is -1 or 1. If
    /// the image ends at `place`, returns the other neighbour, which has the same mosaic colour as
    /// the missing neighbour.
    static std::size_t beside(std::size_t place, std::size_t size, int step) {
        if (size < 2) return place;
        const bool is_beyond = step < 0 ? place == 0 : place + 1 == size;
        return (step < 0) != is_beyond ? place - 1 : place + 1;
    }

    std::size_t width_;
    std::size_t height_;
    std::vector<std::uint16_t> levels_;
};

}  // namespace

dotpose::ImageView grey_view(const RawImage& image, dotpose::GreyImage& buffer) {
    const Encoding& encoding = encoding_of(image);
    require_size(image, encoding);
    if (encoding.samples * encoding.bytes == 1 && !encoding.is_bayer) {
        return {image.data.data(), static_cast<int>(image.width), static_cast<int>(image.height),
                static_cast<std::ptrdiff_t>(image.step)};
    }
    Levels levels(image, encoding);
    if (encoding.is_bayer) levels.mix_colours();
    levels.put_into(buffer);
    return buffer.view();
}

}  // namespace dotpose_ros
