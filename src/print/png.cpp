#include <cmath>
#include <csetjmp>
#include <string>

#include <fmt/core.h>
#include <png.h>

#include "geometry.hpp"
#include "writers.hpp"

namespace dotpose::print {
namespace {

// Compression level of zlib. Pages are nearly empty, and the default level takes 3.5 times as long
// for files that are 20 % smaller.
constexpr int kCompressionLevel = 4;

/// Writes PNG. libpng exits its functions by longjmp after an error. Therefore only `guarded` calls
/// them, without objects in its scope that have a destructor.
class PngWriter {
  public:
    explicit PngWriter(base::OutputFile& file) {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
        if (info_ == nullptr) {
            png_destroy_write_struct(&png_, &info_);
            throw Error("cannot write PNG: libpng did not start");
        }
        png_set_write_fn(png_, &file, on_write, on_flush);
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    void begin(RasterSize size, double dpi) {
        guarded([&] {
            png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
            png_set_IHDR(png_, info_, static_cast<png_uint_32>(size.width_px),
                         static_cast<png_uint_32>(size.height_px), 1, PNG_COLOR_TYPE_GRAY,
                         PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
            const auto per_metre = static_cast<png_uint_32>(std::lround(dpi * 1000 / kInch_mm));
            png_set_pHYs(png_, info_, per_metre, per_metre, PNG_RESOLUTION_METER);
            png_set_compression_level(png_, kCompressionLevel);
            png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
            png_write_info(png_, info_);
            png_set_invert_mono(png_);  // a set bit is ink in a row, but white in PNG
        });
    }
    void row(std::span<const std::uint8_t> bits) {
        guarded([&] { png_write_row(png_, bits.data()); });
    }
    void end() {
        guarded([&] { png_write_end(png_, info_); });
    }

  private:
    template <typename Calls>
    void guarded(const Calls& calls) {
        if (setjmp(png_jmpbuf(png_)) != 0) throw Error("cannot write PNG: " + message_);
        calls();
    }

    static void on_error(png_structp png, png_const_charp message) {
        static_cast<PngWriter*>(png_get_error_ptr(png))->message_ = message;
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_write(png_structp png, png_bytep data, png_size_t size_bytes) {
        static_cast<base::OutputFile*>(png_get_io_ptr(png))->write(data, size_bytes);
    }
    static void on_flush(png_structp) {}

    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::string message_;
};

}  // namespace

void write_png(RasterSize size, double dpi, const RowSource& rows, base::OutputFile& file) {
    PngWriter png(file);
    png.begin(size, dpi);
    rows([&](std::span<const std::uint8_t> bits) {
        png.row(bits);
        file.require_good();
    });
    png.end();
}

}  // namespace dotpose::print
