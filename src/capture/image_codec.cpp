#include "capture/image_codec.hpp"

#include <algorithm>

#include "capture/bmp_codec.hpp"
#include "capture/jpeg_codec.hpp"
#include "capture/png_codec.hpp"
#include "capture/pnm.hpp"
#include "capture/tiff_codec.hpp"

namespace dotpose::capture {

GreyImage decode_image(ImageFormat format, Bytes file, int max_pixels, std::string& note,
                       int page) {
    switch (format) {
        case ImageFormat::pnm:
            return decode_pnm(file, max_pixels);
        case ImageFormat::png:
            return decode_png(file, max_pixels);
        case ImageFormat::jpeg:
            return decode_jpeg(file, max_pixels, note);
        case ImageFormat::bmp:
            return decode_bmp(file, max_pixels);
        case ImageFormat::tiff:
            return decode_tiff(file, max_pixels, page);
    }
    return {};
}

std::optional<Resolution> decode_resolution(ImageFormat format, Bytes file, int page) {
    switch (format) {
        case ImageFormat::pnm:
            return std::nullopt;
        case ImageFormat::png:
            return png_resolution(file);
        case ImageFormat::jpeg:
            return jpeg_resolution(file);
        case ImageFormat::bmp:
            return bmp_resolution(file);
        case ImageFormat::tiff:
            return tiff_resolution(file, page);
    }
    return std::nullopt;
}

int pages_of(ImageFormat format, Bytes file) {
    return format == ImageFormat::tiff ? std::max(tiff_pages(file), 1) : 1;
}

}  // namespace dotpose::capture
