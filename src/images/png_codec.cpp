// Reads PNG with libpng.
#include <bit>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <limits>
#include <new>
#include <string>

#include <png.h>

#include "images/image_format.hpp"
#include "images/samples.hpp"

namespace dotpose::images {
namespace {

/// Reads a PNG file. libpng reports errors with longjmp. Therefore, libpng functions that can fail
/// must be called only through `guarded`, and code passed to `guarded` must not create objects with
/// destructors.
class PngReader {
  public:
    explicit PngReader(Bytes file)
        : rest_(file),
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)),
          info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {}
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    void read_header() {
        if (info_ == nullptr) throw std::bad_alloc();
        png_set_read_fn(png_, this, on_read);
        guarded([&] {
            // The limits of libpng are disabled, because its error messages would not contain the
            // size of the image. `require_size` checks the size instead.
            png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
            png_read_info(png_, info_);
        });
    }

    std::optional<Resolution> resolution() const {
        png_uint_32 x_per_metre = 0;
        png_uint_32 y_per_metre = 0;
        int unit = PNG_RESOLUTION_UNKNOWN;
        png_get_pHYs(png_, info_, &x_per_metre, &y_per_metre, &unit);
        if (unit != PNG_RESOLUTION_METER) return std::nullopt;
        return resolution_from(x_per_metre, y_per_metre, kMetresPerInch);
    }

    /// Returns the EXIF data that precede the pixels, or an empty span if there are none.
    Bytes exif() const {
        png_uint_32 size_bytes = 0;
        png_bytep bytes = nullptr;
        if (png_get_eXIf_1(png_, info_, &size_bytes, &bytes) == 0) return {};
        return {bytes, size_bytes};
    }

    GreyImage read_pixels(int max_pixels) {
        const png_uint_32 width = png_get_image_width(png_, info_);
        const png_uint_32 height = png_get_image_height(png_, info_);
        require_size(width, height, max_pixels);
        guarded([&] {
            // Expands palettes to RGB, samples of fewer than 8 bits to 8 bits, and a transparent
            // colour to an opacity channel.
            png_set_expand(png_);
            if (std::endian::native == std::endian::little) png_set_swap(png_);
            png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
        });
        return png_get_bit_depth(png_, info_) == 16 ? read_samples<std::uint16_t>()
                                                    : read_samples<std::uint8_t>();
    }

  private:
    template <typename Sample>
    GreyImage read_samples() {
        Samples<Sample> samples;
        samples.width_px = static_cast<int>(png_get_image_width(png_, info_));
        samples.height_px = static_cast<int>(png_get_image_height(png_, info_));
        samples.channels = png_get_channels(png_, info_);
        const std::size_t row_bytes = png_get_rowbytes(png_, info_);
        const auto height = static_cast<std::size_t>(samples.height_px);
        samples.values.resize(row_bytes / sizeof(Sample) * height);
        std::vector<png_bytep> rows(height);
        for (std::size_t v = 0; v < height; ++v)
            rows[v] = reinterpret_cast<png_bytep>(samples.values.data()) + v * row_bytes;
        guarded([&] {
            png_read_image(png_, rows.data());
            png_read_end(png_, nullptr);
        });
        return to_grey(std::move(samples));
    }

    template <typename Calls>
    void guarded(const Calls& calls) {
        if (setjmp(png_jmpbuf(png_)) != 0) {
            throw Error(is_short_
                            ? "the PNG image is cut short"
                            : "the PNG image is damaged or of an unknown kind (" + message_ + ")");
        }
        calls();
    }

    static void on_error(png_structp png, png_const_charp message) {
        static_cast<PngReader*>(png_get_error_ptr(png))->message_ = message;
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_read(png_structp png, png_bytep to, png_size_t size_bytes) {
        auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (size_bytes > reader.rest_.size()) {
            reader.is_short_ = true;
            png_error(png, "end of file");
        }
        std::memcpy(to, reader.rest_.data(), size_bytes);
        reader.rest_ = reader.rest_.subspan(size_bytes);
    }

    Bytes rest_;
    bool is_short_ = false;
    std::string message_;
    png_structp png_;
    png_infop info_;
};

}  // namespace

GreyImage decode_png(const ImageInput& input, std::string&) {
    PngReader png(input.file);
    png.read_header();
    return png.read_pixels(input.max_pixels);
}

ImageOrigin png_origin(const ImageInput& input) {
    PngReader png(input.file);
    png.read_header();
    return {is_of_camera(png.exif()), png.resolution()};
}

}  // namespace dotpose::images
