// Reads HEIC and AVIF with libheif.
#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <libheif/heif.h>

#include "images/image_format.hpp"
#include "images/samples.hpp"

namespace dotpose::images {
namespace {

[[noreturn]] void refuse(const char* reason) {
    throw Error(std::string("the HEIC or AVIF image is damaged or of an unknown kind (") + reason +
                ")");
}

void require_ok(const heif_error& error) {
    if (error.code == heif_error_Ok) return;
    if (error.subcode == heif_suberror_End_of_data)
        throw Error("the HEIC or AVIF image is cut short");
    if (error.subcode == heif_suberror_Unsupported_codec) {
        throw Error(
            "libheif has no decoder for this HEIC or AVIF image; Debian 13 has decoders in "
            "libheif-plugin-libde265 and libheif-plugin-dav1d");
    }
    refuse(error.message);
}

template <auto Free>
struct Release {
    template <typename Object>
    void operator()(Object* object) const {
        Free(object);
    }
};
template <typename Object, auto Free>
using Owned = std::unique_ptr<Object, Release<Free>>;

class HeifReader {
  public:
    explicit HeifReader(Bytes file) : context_(heif_context_alloc()) {
        if (!context_) throw std::bad_alloc();
        require_ok(heif_context_read_from_memory_without_copy(context_.get(), file.data(),
                                                              file.size(), nullptr));
        heif_image_handle* handle = nullptr;
        require_ok(heif_context_get_primary_image_handle(context_.get(), &handle));
        handle_.reset(handle);
    }

    GreyImage read_pixels(int max_pixels) const {
        const int width_px = heif_image_handle_get_ispe_width(handle_.get());
        const int height_px = heif_image_handle_get_ispe_height(handle_.get());
        if (width_px < 1 || height_px < 1) refuse("it has no pixels");
        require_size(static_cast<std::uint64_t>(width_px), static_cast<std::uint64_t>(height_px),
                     max_pixels);
        const Owned<heif_decoding_options, heif_decoding_options_free> options(
            heif_decoding_options_alloc());
        if (!options) throw std::bad_alloc();
        options->ignore_transformations = 1;  // the orientation is ignored, as for all formats
        options->convert_hdr_to_8bit = 1;
        options->strict_decoding = 1;
        const bool has_opacity = heif_image_handle_has_alpha_channel(handle_.get()) != 0;
        heif_image* decoded = nullptr;
        require_ok(heif_decode_image(
            handle_.get(), &decoded, heif_colorspace_RGB,
            has_opacity ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB,
            options.get()));
        const Owned<heif_image, heif_image_release> image(decoded);
        if (heif_image_get_width(decoded, heif_channel_interleaved) != width_px ||
            heif_image_get_height(decoded, heif_channel_interleaved) != height_px)
            refuse("its header states another size");
        const int channels = has_opacity ? 4 : 3;
        int stride_bytes = 0;
        const std::uint8_t* row =
            heif_image_get_plane_readonly(decoded, heif_channel_interleaved, &stride_bytes);
        Samples<std::uint8_t> samples{width_px, height_px, channels, {}};
        for (int v = 0; v < height_px; ++v, row += stride_bytes)
            samples.values.insert(samples.values.end(), row, row + channels * width_px);
        return to_grey(std::move(samples));
    }

    /// Returns the EXIF data, starting at the TIFF header, or an empty vector if there are none.
    std::vector<std::uint8_t> exif() const {
        heif_item_id id = 0;
        if (heif_image_handle_get_list_of_metadata_block_IDs(handle_.get(), "Exif", &id, 1) == 0)
            return {};
        std::vector<std::uint8_t> block(heif_image_handle_get_metadata_size(handle_.get(), id));
        require_ok(heif_image_handle_get_metadata(handle_.get(), id, block.data()));
        // The first four bytes contain the offset of the TIFF header, counted from the fifth byte.
        if (block.size() < 4) return {};
        const std::size_t offset = std::size_t{block[0]} << 24 | std::size_t{block[1]} << 16 |
                                   std::size_t{block[2]} << 8 | std::size_t{block[3]};
        block.erase(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(
                                                       std::min(4 + offset, block.size())));
        return block;
    }

  private:
    Owned<heif_context, heif_context_free> context_;
    Owned<const heif_image_handle, heif_image_handle_release> handle_;
};

}  // namespace

GreyImage decode_heif(const ImageInput& input, std::string&) {
    return HeifReader(input.file).read_pixels(input.max_pixels);
}

ImageOrigin heif_origin(const ImageInput& input) {
    return {is_of_camera(HeifReader(input.file).exif()), std::nullopt};
}

}  // namespace dotpose::images
