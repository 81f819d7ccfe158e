/// EXIF data as written by cameras and scanners.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dotpose::test {

/// Tags in the EXIF directory. An entry of the first TIFF directory points to the EXIF directory.
enum ExifTag : std::uint16_t {
    exposure_time = 33434,
    f_number = 33437,
    sensitivity = 34855,
    date_taken = 36867,
    focal_length = 37386,
    file_source = 41728,
};

/// Returns a TIFF structure whose first directory contains a camera maker and points to an EXIF
/// directory with these tags. The first directory also describes an image of one pixel, so the
/// structure is a valid TIFF file.
inline std::string exif_of(const std::vector<std::uint16_t>& tags, bool big_endian) {
    std::string bytes = big_endian ? "MM" : "II";
    const auto add = [&](std::uint32_t value, int size) {
        for (int i = 0; i < size; ++i)
            bytes += static_cast<char>(value >> 8 * (big_endian ? size - 1 - i : i) & 255);
    };
    const auto add_entry = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t value) {
        add(tag, 2);
        add(type, 2);
        add(1, 4);
        add(value, 4);
    };
    constexpr std::uint16_t kByte = 1;
    constexpr std::uint16_t kShort = 3;
    constexpr std::uint16_t kLong = 4;
    constexpr std::uint16_t kRational = 5;
    constexpr std::uint32_t kHeader = 8;
    constexpr std::uint32_t kEntries = 5;
    constexpr std::uint32_t kFirst = 2 + kEntries * 12 + 4;
    add(42, 2);
    add(kHeader, 4);
    add(kEntries, 2);
    add_entry(256, kLong, 1);  // width
    add_entry(257, kLong, 1);
    add_entry(271, kByte, 0);  // maker
    add_entry(273, kLong, 0);  // offset of the pixels
    add_entry(34665, kLong, kHeader + kFirst);
    add(0, 4);
    add(static_cast<std::uint32_t>(tags.size()), 2);
    // The values of the rational entries do not matter, so all of them point to the eight bytes
    // after the header.
    for (const std::uint16_t tag : tags)
        add_entry(tag, tag == sensitivity ? kShort : kRational, kHeader);
    add(0, 4);
    return bytes;
}

/// Returns a JPEG with EXIF data in a segment before the byte at `position`. Position 2 is directly
/// after the start marker, where phones write the EXIF segment. Position 20 is after the JFIF
/// segment, which contains the density.
inline std::string with_exif(std::string jpeg, const std::string& exif, std::size_t position = 20) {
    const std::size_t length = 2 + 6 + exif.size();
    std::string segment = "\xFF\xE1";
    segment += static_cast<char>(length >> 8);
    segment += static_cast<char>(length & 255);
    segment.append("Exif\0\0", 6);
    return jpeg.insert(position, segment + exif);
}

}  // namespace dotpose::test
