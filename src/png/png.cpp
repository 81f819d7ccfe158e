#include "png/png.hpp"

#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <string>
#include <utility>

#include <png.h>

#include "dotpose/files/error.hpp"

namespace dotpose::png {
namespace {

constexpr double kInchesPerMetre = 1 / 0.0254;
// zlib compression level. Pages are mostly empty, so a higher level saves little. At the default
// level, writing takes 3.5 times as long, and the files are only 20 % smaller. Noisy frames do not
// become much smaller at higher levels either.
constexpr int kCompressionLevel = 4;

/// Writes a PNG file. libpng reports errors with longjmp. Therefore, libpng functions that can fail
/// must be called only through `guarded`, and code passed to `guarded` must not create objects with
/// destructors.
class Writer {
  public:
    explicit Writer(base::ByteSink& file) {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
        if (info_ == nullptr) {
            png_destroy_write_struct(&png_, &info_);
            throw Error("cannot write PNG: libpng did not start");
        }
        png_set_write_fn(png_, &file, on_write, on_flush);
    }
    ~Writer() { png_destroy_write_struct(&png_, &info_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    void begin(const Header& header) {
        guarded([&] {
            png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
            png_set_IHDR(png_, info_, static_cast<png_uint_32>(header.width_px),
                         static_cast<png_uint_32>(header.height_px), header.bits_per_px,
                         PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                         PNG_FILTER_TYPE_DEFAULT);
            const auto per_metre =
                static_cast<png_uint_32>(std::lround(header.dpi * kInchesPerMetre));
            if (header.dpi > 0)
                png_set_pHYs(png_, info_, per_metre, per_metre, PNG_RESOLUTION_METER);
            png_set_compression_level(png_, kCompressionLevel);
            png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
            png_write_info(png_, info_);
            if (header.bits_per_px == 1) png_set_invert_mono(png_);
        });
    }
    void row(std::span<const std::uint8_t> pixels) {
        guarded([&] { png_write_row(png_, pixels.data()); });
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
        static_cast<Writer*>(png_get_error_ptr(png))->message_ = message;
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_write(png_structp png, png_bytep data, png_size_t size_bytes) {
        static_cast<base::ByteSink*>(png_get_io_ptr(png))->write(data, size_bytes);
    }
    static void on_flush(png_structp) {}

    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::string message_;
};

struct Memory : base::ByteSink {
    void write(const void* data, std::size_t size_bytes) noexcept override {
        const auto* first = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), first, first + size_bytes);
    }
    std::vector<std::uint8_t> bytes;
};

}  // namespace

void write(const Header& header, const RowSource& rows, base::ByteSink& file) {
    Writer png(file);
    png.begin(header);
    rows([&](std::span<const std::uint8_t> pixels) {
        png.row(pixels);
        file.require_good();
    });
    png.end();
}

std::vector<std::uint8_t> encode(ImageView image) {
    Memory file;
    // `Memory::write` must not throw, so the memory is reserved in advance. The reserved size
    // suffices for incompressible pixels and for the filter byte of each row.
    const std::size_t size_bytes =
        static_cast<std::size_t>(image.height_px) * (static_cast<std::size_t>(image.width_px) + 1);
    file.bytes.reserve(size_bytes + size_bytes / 256 + 1024);
    const auto rows = [&](const RowSink& sink) {
        for (int v = 0; v < image.height_px; ++v)
            sink({image.row(v), static_cast<std::size_t>(image.width_px)});
    };
    write({image.width_px, image.height_px}, rows, file);
    return std::move(file.bytes);
}

}  // namespace dotpose::png
