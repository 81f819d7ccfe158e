#include "encoders.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <utility>

namespace dotpose::test {
namespace {

std::uint64_t number(int value) {
    return static_cast<std::uint64_t>(value);
}

Bytes packed_row(const Raster& raster, int v, bool big_endian = true) {
    Writer row(big_endian);
    const int length = raster.width_px * raster.channels;
    const std::size_t first = static_cast<std::size_t>(v) * static_cast<std::size_t>(length);
    unsigned pending = 0;
    int pending_bits = 0;
    for (int i = 0; i < length; ++i) {
        const unsigned sample = raster.samples.at(first + static_cast<std::size_t>(i));
        if (raster.bits >= 8) {
            row.integers(raster.bits / 8, {sample});
            continue;
        }
        pending = pending << raster.bits | sample;
        pending_bits += raster.bits;
        if (pending_bits == 8 || i + 1 == length) {
            row.integers(1, {pending << (8 - pending_bits)});
            pending = 0;
            pending_bits = 0;
        }
    }
    return row.data;
}

std::uint32_t crc_of(const Bytes& bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

std::uint32_t adler_of(const Bytes& bytes) {
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const std::uint8_t byte : bytes) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

/// Returns a zlib stream with one stored block of up to 65,535 bytes.
Bytes stored(const Bytes& bytes) {
    const Bytes length = Writer(false).integers(2, {bytes.size(), ~bytes.size()}).data;
    return Writer()
        .integers(1, {0x78, 0x01, 0x01})
        .bytes(length)
        .bytes(bytes)
        .integers(4, {adler_of(bytes)})
        .data;
}

void append_chunk(Writer& png, std::string_view type, const Bytes& content) {
    const Bytes body = Writer().text(type).bytes(content).data;
    png.integers(4, {content.size()}).bytes(body).integers(4, {crc_of(body)});
}

class BitWriter {
  public:
    void put(unsigned code, int bits) {
        for (int bit = bits - 1; bit >= 0; --bit) {
            pending_ = pending_ << 1 | (code >> bit & 1);
            if (++count_ == 8) flush();
        }
    }
    Bytes finish() {
        while (count_ != 0)
            put(1, 1);
        return bytes_;
    }

  private:
    void flush() {
        bytes_.push_back(static_cast<std::uint8_t>(pending_));
        if (bytes_.back() == 0xFF) bytes_.push_back(0);
        pending_ = 0;
        count_ = 0;
    }
    Bytes bytes_;
    unsigned pending_ = 0;
    int count_ = 0;
};

/// Returns a scan whose quantizers are all 8. The DC coefficient of a flat block is then its level
/// minus 128.
Bytes jpeg_scan(const Raster& raster) {
    BitWriter scan;
    std::array<int, 4> previous{};
    for (std::size_t i = 0; i < raster.samples.size(); ++i) {
        int& last = previous.at(i % static_cast<std::size_t>(raster.channels));
        const int level = raster.samples[i] - 128;
        const int difference = level - last;
        last = level;
        const auto magnitude = static_cast<unsigned>(difference < 0 ? -difference : difference);
        const int category = static_cast<int>(std::bit_width(magnitude));
        scan.put(static_cast<unsigned>(category), 4);
        scan.put(difference < 0 ? ~magnitude : magnitude, category);
        scan.put(0, 1);  // no AC coefficients
    }
    return scan.finish();
}

/// An entry of a TIFF directory. Its value consists of short integers, or is a single long integer.
struct TiffEntry {
    std::uint64_t tag;
    std::uint64_t count;
    std::uint64_t value;
    bool is_long = false;
};

void append_entry(Writer& tiff, const TiffEntry& entry) {
    tiff.integers(2, {entry.tag, entry.is_long ? 4U : 3U}).integers(4, {entry.count});
    if (entry.count == 1 && !entry.is_long) {
        tiff.integers(2, {entry.value, 0});
    } else {
        tiff.integers(4, {entry.value});
    }
}

/// Returns a TIFF palette with 16 bits per value: all red values, then all green values, then all
/// blue values. `palette` contains one byte each of red, green and blue per colour.
Bytes tiff_palette(const Bytes& palette, bool big_endian) {
    Writer colours(big_endian);
    for (std::size_t channel = 0; !palette.empty() && channel < 3; ++channel) {
        for (std::size_t i = 0; i < 256; ++i) {
            const std::size_t at = 3 * i + channel;
            colours.integers(2, {at < palette.size() ? palette[at] * 257ULL : 0});
        }
    }
    return colours.data;
}

}  // namespace

Writer& Writer::text(std::string_view text) {
    data.insert(data.end(), text.begin(), text.end());
    return *this;
}

Writer& Writer::bytes(const Bytes& bytes) {
    data.insert(data.end(), bytes.begin(), bytes.end());
    return *this;
}

Writer& Writer::integers(int size, std::initializer_list<std::uint64_t> values) {
    for (const std::uint64_t value : values) {
        for (int i = 0; i < size; ++i) {
            const int shift = 8 * (big_endian_ ? size - 1 - i : i);
            data.push_back(static_cast<std::uint8_t>(value >> shift));
        }
    }
    return *this;
}

Bytes encode_pnm(const Raster& raster, bool as_text, int max_value) {
    Writer pnm;
    const int kind = (raster.channels == 3 ? 3 : 2) + (as_text ? 0 : 3);
    pnm.text("P" + std::to_string(kind) + "\n# comment 7\n" + std::to_string(raster.width_px) +
             " " + std::to_string(raster.height_px) + "\n" + std::to_string(max_value) + "\n");
    for (int v = 0; !as_text && v < raster.height_px; ++v)
        pnm.bytes(packed_row(raster, v));
    for (std::size_t i = 0; as_text && i < raster.samples.size(); ++i) {
        pnm.text(std::to_string(raster.samples[i]) + "\n");
    }
    return pnm.data;
}

Bytes encode_png(const Raster& raster, const Bytes& palette, const Bytes& exif) {
    constexpr std::array<std::uint64_t, 5> kColourTypes{0, 0, 4, 2, 6};
    const std::uint64_t colour_type =
        palette.empty() ? kColourTypes.at(static_cast<std::size_t>(raster.channels)) : 3;
    Bytes filtered;
    for (int v = 0; v < raster.height_px; ++v) {
        filtered.push_back(0);
        const Bytes row = packed_row(raster, v);
        filtered.insert(filtered.end(), row.begin(), row.end());
    }
    Writer png;
    png.integers(8, {0x89504E470D0A1A0A});
    append_chunk(png, "IHDR",
                 Writer()
                     .integers(4, {number(raster.width_px), number(raster.height_px)})
                     .integers(1, {number(raster.bits), colour_type, 0, 0, 0})
                     .data);
    if (!palette.empty()) append_chunk(png, "PLTE", palette);
    if (!exif.empty()) append_chunk(png, "eXIf", exif);
    append_chunk(png, "IDAT", stored(filtered));
    append_chunk(png, "IEND", {});
    return png.data;
}

Bytes encode_bmp(const Raster& raster, const Bytes& palette) {
    Writer pixels(false);
    for (int v = raster.height_px - 1; v >= 0; --v) {
        Bytes row = packed_row(raster, v);
        for (std::size_t i = 0; raster.channels == 3 && i + 2 < row.size(); i += 3) {
            std::swap(row[i], row[i + 2]);
        }
        row.resize((row.size() + 3) / 4 * 4);
        pixels.bytes(row);
    }
    Writer colours(false);
    for (std::size_t i = 0; i + 2 < palette.size(); i += 3) {
        colours.integers(1, {palette[i + 2], palette[i + 1], palette[i], 0});
    }
    const std::uint64_t start = 14 + 40 + colours.data.size();
    return Writer(false)
        .text("BM")
        .integers(4, {start + pixels.data.size(), 0, start})
        .integers(4, {40, number(raster.width_px), number(raster.height_px)})
        .integers(2, {1, number(raster.channels * raster.bits)})
        .integers(4, {0, pixels.data.size(), 2835, 2835, palette.size() / 3, 0})
        .bytes(colours.data)
        .bytes(pixels.data)
        .data;
}

Bytes encode_tiff(const Raster& raster, bool big_endian, const Bytes& palette) {
    constexpr std::uint64_t kDirectoryAt = 8;
    constexpr std::uint64_t kEntries = 10;
    // The directory is followed by the bit depth of each channel, the palette, and the pixels.
    constexpr std::uint64_t kBitsAt = kDirectoryAt + 2 + kEntries * 12 + 4;
    constexpr std::uint64_t kPaletteAt = kBitsAt + 8;
    const Bytes colours = tiff_palette(palette, big_endian);
    Writer pixels(big_endian);
    for (int v = 0; v < raster.height_px; ++v)
        pixels.bytes(packed_row(raster, v, big_endian));
    const auto channels = number(raster.channels);
    const auto bits = number(raster.bits);
    const std::uint64_t colour_space = !palette.empty() ? 3 : channels >= 3 ? 2 : 1;
    TiffEntry last{296, 1, 2};  // resolution unit, which has no effect here
    if (channels % 2 == 0) last = {338, 1, 2};
    if (!palette.empty()) last = {320, 768, kPaletteAt};

    Writer tiff(big_endian);
    tiff.text(big_endian ? "MM" : "II").integers(2, {42}).integers(4, {kDirectoryAt});
    tiff.integers(2, {kEntries});
    append_entry(tiff, {256, 1, number(raster.width_px), true});
    append_entry(tiff, {257, 1, number(raster.height_px), true});
    // Two shorts fit into the entry itself. The first short is at the lower address.
    const std::uint64_t two_bits = big_endian ? bits << 16 | bits : bits | bits << 16;
    append_entry(tiff, {258, channels, channels == 1 ? bits : channels == 2 ? two_bits : kBitsAt});
    append_entry(tiff, {259, 1, 1});
    append_entry(tiff, {262, 1, colour_space});
    append_entry(tiff, {273, 1, kPaletteAt + colours.size(), true});
    append_entry(tiff, {277, 1, channels});
    append_entry(tiff, {278, 1, number(raster.height_px), true});
    append_entry(tiff, {279, 1, pixels.data.size(), true});
    append_entry(tiff, last);
    tiff.integers(4, {0}).integers(2, {bits, bits, bits, bits});
    return tiff.bytes(colours).bytes(pixels.data).data;
}

Bytes encode_jpeg(const Raster& raster) {
    const auto channels = number(raster.channels);
    Writer jpeg;
    jpeg.integers(2, {0xFFD8});
    if (channels == 4) {
        jpeg.integers(2, {0xFFEE, 14}).text("Adobe").integers(1, {0, 100, 0, 0, 0, 0, 0});
    }
    jpeg.integers(2, {0xFFDB, 67}).integers(1, {0}).bytes(Bytes(64, 8));
    jpeg.integers(2, {0xFFC0, 8 + 3 * channels}).integers(1, {8});
    jpeg.integers(2, {number(8 * raster.height_px), number(8 * raster.width_px)});
    jpeg.integers(1, {channels});
    for (std::uint64_t i = 1; i <= channels; ++i)
        jpeg.integers(1, {i, 0x11, 0});
    // The DC table has twelve codes of four bits, for the categories 0 to 11. The AC table has one
    // code of one bit, for the end of a block.
    jpeg.integers(2, {0xFFC4, 31}).integers(1, {0x00, 0, 0, 0, 12}).bytes(Bytes(12, 0));
    for (std::uint64_t i = 0; i < 12; ++i)
        jpeg.integers(1, {i});
    jpeg.integers(2, {0xFFC4, 20}).integers(1, {0x10, 1}).bytes(Bytes(15, 0)).integers(1, {0});
    jpeg.integers(2, {0xFFDA, 6 + 2 * channels}).integers(1, {channels});
    for (std::uint64_t i = 1; i <= channels; ++i)
        jpeg.integers(1, {i, 0});
    jpeg.integers(1, {0, 63, 0}).bytes(jpeg_scan(raster)).integers(2, {0xFFD9});
    return jpeg.data;
}

}  // namespace dotpose::test
