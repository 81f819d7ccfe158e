#include <memory>
#include <vector>

#include <tiffio.h>

#include "writers.hpp"

namespace dotpose::print {
namespace {

// Images of at least this size are written as BigTIFF. Offsets in classic TIFF have only 32 bits.
constexpr std::int64_t kBigTiff_bytes = std::int64_t{1} << 31;
constexpr std::uint32_t kRowsPerStrip = 64;

// Always reports success to libtiff. OutputFile stores the first failure with its reason.
tmsize_t on_write(thandle_t handle, void* data, tmsize_t size_bytes) {
    static_cast<base::OutputFile*>(handle)->write(data, static_cast<std::size_t>(size_bytes));
    return size_bytes;
}
toff_t on_seek(thandle_t handle, toff_t offset, int whence) {
    const auto signed_offset = static_cast<std::int64_t>(offset);
    return static_cast<toff_t>(static_cast<base::OutputFile*>(handle)->seek(signed_offset, whence));
}
tmsize_t on_read(thandle_t, void*, tmsize_t) {
    return 0;
}
int on_close(thandle_t) {
    return 0;
}
toff_t on_size(thandle_t) {
    return 0;
}

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff open_tiff(RasterSize size, double dpi, base::OutputFile& file) {
    const std::int64_t bytes = std::int64_t{size.width_px} * size.height_px / 8;
    Tiff tiff(TIFFClientOpen("sheet", bytes < kBigTiff_bytes ? "w" : "w8", &file, on_read, on_write,
                             on_seek, on_close, on_size, nullptr, nullptr),
              TIFFClose);
    if (tiff == nullptr) throw Error("cannot write TIFF: libtiff did not start");
    TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(size.width_px));
    TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(size.height_px));
    TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 1);
    TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_CCITTFAX4);
    TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISWHITE);
    TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, kRowsPerStrip);
    TIFFSetField(tiff.get(), TIFFTAG_XRESOLUTION, dpi);
    TIFFSetField(tiff.get(), TIFFTAG_YRESOLUTION, dpi);
    TIFFSetField(tiff.get(), TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
    return tiff;
}

}  // namespace

void write_tiff(RasterSize size, double dpi, const png::RowSource& rows, base::OutputFile& file) {
    const Tiff tiff = open_tiff(size, dpi, file);
    std::vector<std::uint8_t> row;
    std::uint32_t row_index = 0;
    rows([&](std::span<const std::uint8_t> bits) {
        row.assign(bits.begin(), bits.end());  // a copy, because libtiff may modify the row
        if (TIFFWriteScanline(tiff.get(), row.data(), row_index++, 0) != 1) {
            throw Error("cannot write TIFF: libtiff refused a row");
        }
        file.require_good();
    });
    if (TIFFFlush(tiff.get()) != 1) throw Error("cannot write TIFF: libtiff refused the directory");
}

}  // namespace dotpose::print
