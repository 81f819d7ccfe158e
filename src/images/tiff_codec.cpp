// Reads TIFF with libtiff.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <tiffio.h>

#include "images/image_format.hpp"
#include "images/samples.hpp"

namespace dotpose::images {
namespace {

/// A file in memory, and the first error reported by libtiff.
struct Input {
    Bytes file;
    std::uint64_t at = 0;
    bool is_short = false;
    std::array<char, 200> message{};
};

tmsize_t on_read(thandle_t handle, void* to, tmsize_t size_bytes) {
    auto& input = *static_cast<Input*>(handle);
    const std::uint64_t rest = input.at < input.file.size() ? input.file.size() - input.at : 0;
    const std::uint64_t count = std::min(rest, static_cast<std::uint64_t>(size_bytes));
    if (count < static_cast<std::uint64_t>(size_bytes)) input.is_short = true;
    if (count > 0) std::memcpy(to, input.file.data() + input.at, count);
    input.at += count;
    return static_cast<tmsize_t>(count);
}
tmsize_t on_write(thandle_t, void*, tmsize_t) {
    return 0;
}
toff_t on_seek(thandle_t handle, toff_t offset, int whence) {
    auto& input = *static_cast<Input*>(handle);
    const std::uint64_t from = whence == SEEK_CUR   ? input.at
                               : whence == SEEK_END ? input.file.size()
                                                    : 0;
    return input.at = from + offset;
}
int on_close(thandle_t) {
    return 0;
}
toff_t on_size(thandle_t handle) {
    return static_cast<Input*>(handle)->file.size();
}
int on_error(TIFF*, void* user, const char*, const char* format, std::va_list arguments) {
    auto& message = static_cast<Input*>(user)->message;
    // Only the first error is kept, because it causes the later ones.
    if (message[0] == '\0') std::vsnprintf(message.data(), message.size(), format, arguments);
    return 1;
}
int on_warning(TIFF*, void*, const char*, const char*, std::va_list) {
    return 1;
}

class TiffReader {
  public:
    explicit TiffReader(Bytes file) : input_{file} {
        const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
            TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
        if (!options) throw std::bad_alloc();
        TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &input_);
        TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &input_);
        TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), tmsize_t{8} * kMaxImagePixels);
        tiff_.reset(TIFFClientOpenExt("image", "r", &input_, on_read, on_write, on_seek, on_close,
                                      on_size, nullptr, nullptr, options.get()));
        // libtiff silently treats a truncated directory as the last directory, so missing bytes
        // are reported as an error here.
        if (!tiff_ || input_.is_short) fail();
    }

    void go_to(int page) {
        if (TIFFSetDirectory(tiff_.get(), static_cast<tdir_t>(page - 1)) == 0 || input_.is_short)
            fail();
    }

    int pages() const { return static_cast<int>(TIFFNumberOfDirectories(tiff_.get())); }

    std::optional<Resolution> resolution() const {
        float x = 0;
        float y = 0;
        std::uint16_t unit = RESUNIT_NONE;
        TIFFGetField(tiff_.get(), TIFFTAG_XRESOLUTION, &x);
        TIFFGetField(tiff_.get(), TIFFTAG_YRESOLUTION, &y);
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_RESOLUTIONUNIT, &unit);
        if (unit != RESUNIT_INCH && unit != RESUNIT_CENTIMETER) return std::nullopt;
        return resolution_from(double{x}, double{y},
                               unit == RESUNIT_CENTIMETER ? kCentimetresPerInch : 1);
    }

    /// Returns true if the page has EXIF data written by a camera. If there is an EXIF directory,
    /// it becomes libtiff's current directory.
    bool read_is_of_camera() {
        toff_t exif = 0;
        if (TIFFGetField(tiff_.get(), TIFFTAG_EXIFIFD, &exif) == 0 ||
            TIFFReadEXIFDirectory(tiff_.get(), exif) == 0)
            return false;
        return std::ranges::any_of(kCameraTags, [&](std::uint16_t tag) {
            // Depending on the tag, libtiff writes either one value, or the number of values and a
            // pointer to them.
            std::uint64_t value = 0;
            const void* values = nullptr;
            return TIFFGetField(tiff_.get(), tag, &value, &values) != 0;
        });
    }

    GreyImage read_pixels(int max_pixels) {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        TIFFGetField(tiff_.get(), TIFFTAG_IMAGEWIDTH, &width);
        TIFFGetField(tiff_.get(), TIFFTAG_IMAGELENGTH, &height);
        if (width == 0 || height == 0) fail();
        require_size(width, height, max_pixels);
        width_px_ = static_cast<int>(width);
        height_px_ = static_cast<int>(height);
        if (!has_plain_samples()) return read_rgba();
        return tag(TIFFTAG_BITSPERSAMPLE) == 16 ? read_samples<std::uint16_t>()
                                                : read_samples<std::uint8_t>();
    }

  private:
    struct Close {
        void operator()(TIFF* tiff) const { TIFFClose(tiff); }
    };

    /// Returns the value of a 16-bit tag, or the tag's default value if it is not set.
    std::uint16_t tag(std::uint32_t name) const {
        std::uint16_t value = 0;
        TIFFGetFieldDefaulted(tiff_.get(), name, &value);
        return value;
    }

    /// Returns the type of the first sample after the colours, for example EXTRASAMPLE_UNASSALPHA.
    std::uint16_t extra_sample() const {
        std::uint16_t count = 0;
        const std::uint16_t* kinds = nullptr;
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
        return count > 0 ? kinds[0] : std::uint16_t{EXTRASAMPLE_UNSPECIFIED};
    }

    int colours() const { return tag(TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_RGB ? 3 : 1; }

    /// Returns true if the samples are interleaved grey or RGB samples of 8 or 16 bits, which are
    /// read without conversion. libtiff converts all other formats to 8-bit RGB.
    bool has_plain_samples() const {
        const std::uint16_t bits = tag(TIFFTAG_BITSPERSAMPLE);
        std::uint16_t photometric = PHOTOMETRIC_PALETTE;
        TIFFGetField(tiff_.get(), TIFFTAG_PHOTOMETRIC, &photometric);
        return (bits == 8 || bits == 16) && tag(TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_UINT &&
               tag(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG &&
               tag(TIFFTAG_SAMPLESPERPIXEL) >= colours() &&
               (photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_RGB);
    }

    template <typename Sample>
    GreyImage read_samples() {
        const std::size_t per_pixel = tag(TIFFTAG_SAMPLESPERPIXEL);
        std::vector<Sample> stored(per_pixel * static_cast<std::size_t>(width_px_) *
                                   static_cast<std::size_t>(height_px_));
        if (TIFFIsTiled(tiff_.get()) != 0) {
            read_tiles(stored.data(), per_pixel * sizeof(Sample));
        } else {
            read_strips(stored.data(), per_pixel * sizeof(Sample));
        }
        return to_grey(plain(std::move(stored), per_pixel));
    }

    void read_strips(void* to, std::size_t pixel_bytes) {
        const auto row_bytes =
            static_cast<tmsize_t>(pixel_bytes * static_cast<std::size_t>(width_px_));
        std::uint32_t per_strip = 0;
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_ROWSPERSTRIP, &per_strip);
        const auto height = static_cast<std::uint32_t>(height_px_);
        per_strip = std::clamp(per_strip, 1U, height);
        auto* row = static_cast<std::uint8_t*>(to);
        for (std::uint32_t v = 0; v < height; v += per_strip) {
            const tmsize_t bytes = row_bytes * std::min(per_strip, height - v);
            if (TIFFReadEncodedStrip(tiff_.get(), v / per_strip, row, bytes) != bytes) fail();
            row += bytes;
        }
    }

    void read_tiles(void* to, std::size_t pixel_bytes) {
        std::uint32_t tile_width = 0;
        std::uint32_t tile_height = 0;
        TIFFGetField(tiff_.get(), TIFFTAG_TILEWIDTH, &tile_width);
        TIFFGetField(tiff_.get(), TIFFTAG_TILELENGTH, &tile_height);
        std::vector<std::uint8_t> tile(static_cast<std::size_t>(TIFFTileSize(tiff_.get())));
        const std::size_t tile_row_bytes = tile_width * pixel_bytes;
        if (tile_row_bytes == 0 || tile.size() < tile_row_bytes * tile_height) fail();
        const auto width = static_cast<std::uint32_t>(width_px_);
        const auto height = static_cast<std::uint32_t>(height_px_);
        for (std::uint32_t v = 0; v < height; v += tile_height) {
            for (std::uint32_t u = 0; u < width; u += tile_width) {
                if (TIFFReadTile(tiff_.get(), tile.data(), u, v, 0, 0) < 0) fail();
                const std::size_t bytes = std::min(tile_width, width - u) * pixel_bytes;
                for (std::uint32_t row = 0; row < std::min(tile_height, height - v); ++row) {
                    std::memcpy(static_cast<std::uint8_t*>(to) +
                                    (std::size_t{v + row} * width + u) * pixel_bytes,
                                tile.data() + row * tile_row_bytes, bytes);
                }
            }
        }
    }

    /// Keeps only the colours and the opacity of each pixel. If the colours are premultiplied by
    /// the opacity, composites them onto white and removes the opacity.
    template <typename Sample>
    Samples<Sample> plain(std::vector<Sample> stored, std::size_t per_pixel) const {
        const auto colours = static_cast<std::size_t>(this->colours());
        const std::uint16_t extra = per_pixel > colours ? extra_sample() : std::uint16_t{0};
        const bool is_multiplied = extra == EXTRASAMPLE_ASSOCALPHA;
        const std::size_t channels = colours + (extra == EXTRASAMPLE_UNASSALPHA ? 1 : 0);
        Samples<Sample> samples{width_px_, height_px_, static_cast<int>(channels), {}};
        if (channels == per_pixel) {
            samples.values = std::move(stored);
            return samples;
        }
        constexpr int kFull = std::numeric_limits<Sample>::max();
        samples.values.reserve(stored.size() / per_pixel * channels);
        for (std::size_t i = 0; i < stored.size(); i += per_pixel) {
            const int white = is_multiplied ? kFull - stored[i + colours] : 0;
            for (std::size_t channel = 0; channel < channels; ++channel) {
                const int value = std::min(stored[i + channel] + white, kFull);
                samples.values.push_back(static_cast<Sample>(value));
            }
        }
        return samples;
    }

    /// Reads the formats that libtiff must convert: palettes, samples of fewer than 8 bits, fax
    /// compression, YCbCr, CMYK and separate planes.
    GreyImage read_rgba() {
        std::array<char, 1024> reason{};
        TIFFRGBAImage image{};
        if (TIFFRGBAImageOK(tiff_.get(), reason.data()) == 0 ||
            TIFFRGBAImageBegin(&image, tiff_.get(), 1, reason.data()) == 0) {
            if (input_.message[0] == '\0')
                std::copy_n(reason.begin(), input_.message.size() - 1, input_.message.begin());
            fail();
        }
        // The orientation tag is ignored, as it is for all image formats.
        image.orientation = ORIENTATION_TOPLEFT;
        image.req_orientation = ORIENTATION_TOPLEFT;
        const auto width = static_cast<std::uint32_t>(width_px_);
        const auto height = static_cast<std::uint32_t>(height_px_);
        std::vector<std::uint32_t> pixels(std::size_t{width} * height);
        const bool is_read = TIFFRGBAImageGet(&image, pixels.data(), width, height) != 0;
        TIFFRGBAImageEnd(&image);
        if (!is_read) fail();
        Samples<std::uint8_t> samples{width_px_, height_px_, 3, {}};
        samples.values.reserve(3 * pixels.size());
        for (const std::uint32_t abgr : pixels) {
            // libtiff returns colours that are premultiplied by the opacity. Adding white in
            // proportion to the transparency composites them onto white.
            const std::uint32_t white = 255 - TIFFGetA(abgr);
            for (const std::uint32_t colour : {TIFFGetR(abgr), TIFFGetG(abgr), TIFFGetB(abgr)})
                samples.values.push_back(static_cast<std::uint8_t>(std::min(colour + white, 255U)));
        }
        return to_grey(std::move(samples));
    }

    [[noreturn]] void fail() const {
        if (input_.is_short) throw Error("the TIFF image is cut short");
        const std::string reason = input_.message.data();
        throw Error("the TIFF image is damaged or of an unknown kind" +
                    (reason.empty() ? "" : " (" + reason + ")"));
    }

    Input input_;
    std::unique_ptr<TIFF, Close> tiff_;
    int width_px_ = 0;
    int height_px_ = 0;
};

}  // namespace

GreyImage decode_tiff(const ImageInput& input, std::string&) {
    TiffReader tiff(input.file);
    tiff.go_to(input.page);
    return tiff.read_pixels(input.max_pixels);
}

ImageOrigin tiff_origin(const ImageInput& input) {
    TiffReader tiff(input.file);
    tiff.go_to(input.page);
    const auto resolution = tiff.resolution();
    return {tiff.read_is_of_camera(), resolution};
}

int tiff_pages(Bytes file) {
    return TiffReader(file).pages();
}

}  // namespace dotpose::images
