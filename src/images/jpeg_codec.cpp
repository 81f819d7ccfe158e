// Reads and writes JPEG with libjpeg.
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // required by jpeglib.h
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include <jpeglib.h>

#include "images/image_format.hpp"
#include "images/samples.hpp"

namespace dotpose::images {
namespace {

constexpr int kQuality = 95;
constexpr int kExifMarker = JPEG_APP0 + 1;
// Maximum number of scans. Each scan processes all pixels, so a small file with many scans could
// occupy the decoder for hours. Progressive images from cameras have about ten scans.
constexpr int kMaxScans = 100;

/// Collects the messages from libjpeg. The error handler must not return to libjpeg, so it jumps to
/// `leave`. Each call that can fail must follow setjmp(leave), and no objects with destructors may
/// be created between setjmp and the call.
struct Report : jpeg_error_mgr {
    std::jmp_buf leave;
    std::array<char, JMSG_LENGTH_MAX> message{};

    Report() {
        jpeg_std_error(this);
        error_exit = [](j_common_ptr jpeg) {
            auto& report = *static_cast<Report*>(jpeg->err);
            report.format_message(jpeg, report.message.data());
            std::longjmp(report.leave, 1);
        };
        // Messages with a level below 0 are warnings. Only the first warning is kept.
        emit_message = [](j_common_ptr jpeg, int level) {
            auto& report = *static_cast<Report*>(jpeg->err);
            if (level >= 0) return;
            if (report.num_warnings++ == 0) report.format_message(jpeg, report.message.data());
        };
        output_message = [](j_common_ptr) {};
    }
};

/// The bytes of a file, followed by an end marker in case the file has none.
struct Source : jpeg_source_mgr {
    bool is_short = false;

    explicit Source(Bytes file) : jpeg_source_mgr{} {
        next_input_byte = file.data();
        bytes_in_buffer = file.size();
        init_source = [](j_decompress_ptr) {};
        fill_input_buffer = [](j_decompress_ptr jpeg) -> boolean {
            static constexpr std::array<JOCTET, 2> kEnd{0xFF, JPEG_EOI};
            auto& source = *static_cast<Source*>(jpeg->src);
            source.is_short = true;
            source.next_input_byte = kEnd.data();
            source.bytes_in_buffer = kEnd.size();
            return TRUE;
        };
        skip_input_data = [](j_decompress_ptr jpeg, long bytes) {
            auto& source = *static_cast<Source*>(jpeg->src);
            if (bytes <= 0) return;
            if (static_cast<std::size_t>(bytes) > source.bytes_in_buffer) {
                source.fill_input_buffer(jpeg);
                return;
            }
            source.next_input_byte += bytes;
            source.bytes_in_buffer -= static_cast<std::size_t>(bytes);
        };
        resync_to_restart = jpeg_resync_to_restart;
        term_source = [](j_decompress_ptr) {};
    }
};

class JpegReader {
  public:
    explicit JpegReader(Bytes file) : source_(file) {
        jpeg_.err = &report_;
        progress_.progress_monitor = [](j_common_ptr jpeg) {
            if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMaxScans) return;
            auto& report = *static_cast<Report*>(jpeg->err);
            std::snprintf(report.message.data(), report.message.size(), "too many scans");
            std::longjmp(report.leave, 1);
        };
    }
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    void read_header() {
        guarded([&] {
            jpeg_create_decompress(&jpeg_);
            jpeg_.src = &source_;
            jpeg_.progress = &progress_;
            jpeg_save_markers(&jpeg_, kExifMarker, 0xFFFF);
            jpeg_read_header(&jpeg_, TRUE);
        });
    }

    std::optional<Resolution> resolution() const {
        constexpr int kPerCentimetre = 2;
        if (jpeg_.saw_JFIF_marker == FALSE || jpeg_.density_unit == 0) return std::nullopt;
        return resolution_from(jpeg_.X_density, jpeg_.Y_density,
                               jpeg_.density_unit == kPerCentimetre ? kCentimetresPerInch : 1);
    }

    /// Returns the EXIF data, or an empty span if there are none.
    Bytes exif() const {
        constexpr std::string_view kName = "Exif";
        for (auto* marker = jpeg_.marker_list; marker != nullptr; marker = marker->next) {
            if (marker->data_length > kName.size() &&
                std::memcmp(marker->data, kName.data(), kName.size()) == 0)
                return {marker->data, marker->data_length};
        }
        return {};
    }

    GreyImage read_pixels(int max_pixels, std::string& note) {
        require_size(jpeg_.image_width, jpeg_.image_height, max_pixels);
        jpeg_.out_color_space = output_space();
        guarded([&] { jpeg_start_decompress(&jpeg_); });
        Samples<std::uint8_t> samples{static_cast<int>(jpeg_.output_width),
                                      static_cast<int>(jpeg_.output_height),
                                      jpeg_.output_components,
                                      {}};
        const std::size_t row_bytes =
            std::size_t{jpeg_.output_width} * static_cast<std::size_t>(jpeg_.output_components);
        samples.values.resize(row_bytes * jpeg_.output_height);
        guarded([&] {
            while (jpeg_.output_scanline < jpeg_.output_height) {
                JSAMPROW row = samples.values.data() + jpeg_.output_scanline * row_bytes;
                jpeg_read_scanlines(&jpeg_, &row, 1);
            }
            jpeg_finish_decompress(&jpeg_);
        });
        // libjpeg replaces missing or damaged pixels with invented values, and only issues a
        // warning.
        if (report_.num_warnings > 0) fail();
        if (source_.is_short) {
            // In progressive files, whole scans may be missing without a warning, so a file that
            // ends early is an error.
            if (jpeg_.progressive_mode != FALSE) fail();
            note = "the JPEG image lacks its end marker; its pixels are complete";
        }
        return to_grey(jpeg_.out_color_space == JCS_CMYK ? rgb_of(samples) : std::move(samples));
    }

  private:
    /// Returns the output colour space to request from libjpeg. For YCbCr files, this is grey, to
    /// obtain the luma without a conversion to RGB and back.
    J_COLOR_SPACE output_space() const {
        switch (jpeg_.jpeg_color_space) {
            case JCS_GRAYSCALE:
            case JCS_YCbCr:
                return JCS_GRAYSCALE;
            case JCS_CMYK:
            case JCS_YCCK:
                return JCS_CMYK;
            default:
                return JCS_RGB;
        }
    }

    /// Converts CMYK to RGB. JPEG files store CMYK inverted, so 255 means no ink.
    static Samples<std::uint8_t> rgb_of(const Samples<std::uint8_t>& inks) {
        Samples<std::uint8_t> rgb{inks.width_px, inks.height_px, 3, {}};
        rgb.values.reserve(inks.values.size() / 4 * 3);
        for (std::size_t i = 0; i + 3 < inks.values.size(); i += 4) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const int product = inks.values[i + channel] * inks.values[i + 3];
                rgb.values.push_back(static_cast<std::uint8_t>((product + 127) / 255));
            }
        }
        return rgb;
    }

    template <typename Calls>
    void guarded(const Calls& calls) {
        if (setjmp(report_.leave) != 0) fail();
        calls();
    }
    [[noreturn]] void fail() const {
        if (source_.is_short) throw Error("the JPEG image is cut short");
        throw Error("the JPEG image is damaged or of an unknown kind (" +
                    std::string(report_.message.data()) + ")");
    }

    Report report_;
    Source source_;
    jpeg_progress_mgr progress_{};
    jpeg_decompress_struct jpeg_{};
};

/// Frees the buffer of encoded bytes that libjpeg allocates.
struct Freed {
    unsigned char* bytes = nullptr;
    unsigned long count = 0;
    ~Freed() { std::free(bytes); }
};

void compress(ImageView image, jpeg_compress_struct& jpeg, Freed& encoded) {
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &encoded.bytes, &encoded.count);
    jpeg.image_width = static_cast<JDIMENSION>(image.width_px);
    jpeg.image_height = static_cast<JDIMENSION>(image.height_px);
    jpeg.input_components = 1;
    jpeg.in_color_space = JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, kQuality, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (int v = 0; v < image.height_px; ++v) {
        // The cast is safe, because libjpeg does not modify the pixels.
        JSAMPROW row = const_cast<JSAMPROW>(image.row(v));
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
}

}  // namespace

GreyImage decode_jpeg(const ImageInput& input, std::string& note) {
    JpegReader jpeg(input.file);
    jpeg.read_header();
    return jpeg.read_pixels(input.max_pixels, note);
}

ImageOrigin jpeg_origin(const ImageInput& input) {
    JpegReader jpeg(input.file);
    jpeg.read_header();
    return {is_of_camera(jpeg.exif()), jpeg.resolution()};
}

std::vector<std::uint8_t> encode_jpeg(ImageView image) {
    Report report;
    Freed encoded;
    jpeg_compress_struct jpeg{};
    jpeg.err = &report;
    const bool is_done = setjmp(report.leave) == 0 && (compress(image, jpeg, encoded), true);
    jpeg_destroy_compress(&jpeg);
    if (!is_done) throw Error(std::string("the JPEG encoder failed: ") + report.message.data());
    return {encoded.bytes, encoded.bytes + encoded.count};
}

}  // namespace dotpose::images
