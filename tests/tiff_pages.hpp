/// A TIFF file with several pages, as written by scanners with a document feeder.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::test {

/// Returns the file, little-endian and uncompressed. `dpi` is an integer.
inline std::string tiff_of_pages(const std::vector<GreyImage>& pages, std::uint32_t dpi) {
    std::string file = "II*";
    const auto put = [&file](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            file += static_cast<char>(value >> (8 * i));
    };
    file += '\0';
    put(8, 4);  // offset of the first directory
    constexpr std::uint32_t kEntries = 11;
    for (std::size_t page = 0; page < pages.size(); ++page) {
        const GreyImage& image = pages[page];
        const auto width = static_cast<std::uint32_t>(image.width_px);
        const auto height = static_cast<std::uint32_t>(image.height_px);
        const auto start = static_cast<std::uint32_t>(file.size());
        const std::uint32_t resolution_at = start + 2 + 12 * kEntries + 4;
        const std::uint32_t pixels_at = resolution_at + 8;
        std::uint32_t next = pixels_at + width * height;
        next += next % 2;
        put(kEntries, 2);
        for (const auto& [tag, type, value] :
             std::initializer_list<std::array<std::uint32_t, 3>>{{256, 4, width},
                                                                 {257, 4, height},
                                                                 {258, 3, 8},
                                                                 {259, 3, 1},
                                                                 {262, 3, 1},
                                                                 {273, 4, pixels_at},
                                                                 {278, 4, height},
                                                                 {279, 4, width * height},
                                                                 {282, 5, resolution_at},
                                                                 {283, 5, resolution_at},
                                                                 {296, 3, 2}}) {
            put(tag, 2);
            put(type, 2);
            put(1, 4);
            put(value, 4);
        }
        put(page + 1 < pages.size() ? next : 0, 4);
        put(dpi, 4);
        put(1, 4);
        file.append(image.pixels.begin(), image.pixels.end());
        file.resize(next);
    }
    return file;
}

}  // namespace dotpose::test
