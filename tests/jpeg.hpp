/// JPEG files as written by scanners.
#pragma once

#include <cstdio>  // required before jpeglib.h
#include <cstdlib>
#include <memory>
#include <string>

#include <jpeglib.h>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::test {

/// Returns a grey JPEG, baseline or progressive. If `dpi` is 0, the file has no density.
inline std::string jpeg_of(const GreyImage& image, int quality, int dpi = 0,
                           bool is_progressive = false) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = static_cast<JDIMENSION>(image.width_px);
    jpeg.image_height = static_cast<JDIMENSION>(image.height_px);
    jpeg.input_components = 1;
    jpeg.in_color_space = JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    if (is_progressive) jpeg_simple_progression(&jpeg);
    if (dpi > 0) {
        jpeg.density_unit = 1;
        jpeg.X_density = jpeg.Y_density = static_cast<UINT16>(dpi);
    }
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        JSAMPROW row = const_cast<JSAMPROW>(image.view().row(static_cast<int>(jpeg.next_scanline)));
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    const std::string content(reinterpret_cast<char*>(bytes), size);
    jpeg_destroy_compress(&jpeg);
    std::free(bytes);
    return content;
}

}  // namespace dotpose::test
