/// Encoders of image files. They do not use an image library, to keep the tests independent of the
/// libraries used by the reader.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace dotpose::test {

using Bytes = std::vector<std::uint8_t>;

/// A sequence of bytes under construction. Integers are appended in the chosen byte order.
class Writer {
  public:
    explicit Writer(bool big_endian = true) : big_endian_(big_endian) {}

    Writer& text(std::string_view text);
    Writer& bytes(const Bytes& bytes);
    /// Appends the low `size` bytes of each value.
    Writer& integers(int size, std::initializer_list<std::uint64_t> values);

    Bytes data;

  private:
    bool big_endian_;
};

/// Samples row by row, with `channels` channels per pixel and `bits` bits per sample. `bits` is 8
/// or 16. For PNG, it may also be less than 8.
struct Raster {
    int width_px = 0;
    int height_px = 0;
    int channels = 1;
    int bits = 8;
    std::vector<std::uint16_t> samples;
};

/// Encodes 1 channel as P2 or P5, and 3 channels as P3 or P6.
Bytes encode_pnm(const Raster& raster, bool as_text, int max_value);

/// Encodes 1 to 4 channels: grey, grey and opacity, RGB, or RGBA. If there is a palette of RGB
/// triples, the single channel contains indices into it.
Bytes encode_png(const Raster& raster, const Bytes& palette = {}, const Bytes& exif = {});

/// Encodes 8-bit samples. One channel contains indices into the palette of RGB triples. Three
/// channels are RGB.
Bytes encode_bmp(const Raster& raster, const Bytes& palette = {});

/// Encodes an uncompressed file with a single strip. The directory precedes the pixels. Channels
/// and palette are as in encode_png.
Bytes encode_tiff(const Raster& raster, bool big_endian, const Bytes& palette = {});

/// Encodes a baseline JPEG. Each 8-bit sample becomes a flat block of 8 x 8 px, which JPEG
/// reproduces exactly. One channel is grey. Three channels are Y, Cb and Cr. Four channels are
/// CMYK, stored inverted as in Adobe programs.
Bytes encode_jpeg(const Raster& raster);

}  // namespace dotpose::test
