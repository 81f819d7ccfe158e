// Reads WebP with libwebp.
#include <memory>
#include <new>
#include <utility>

#include <webp/decode.h>
#include <webp/demux.h>

#include "images/image_format.hpp"
#include "images/samples.hpp"

namespace dotpose::images {
namespace {

void require_ok(VP8StatusCode status) {
    if (status == VP8_STATUS_OK) return;
    if (status == VP8_STATUS_OUT_OF_MEMORY) throw std::bad_alloc();
    throw Error(status == VP8_STATUS_NOT_ENOUGH_DATA || status == VP8_STATUS_SUSPENDED
                    ? "the WebP image is cut short"
                    : "the WebP image is damaged or of an unknown kind");
}

}  // namespace

GreyImage decode_webp(const ImageInput& input, std::string&) {
    WebPDecoderConfig config{};
    WebPInitDecoderConfig(&config);
    const WebPBitstreamFeatures& features = config.input;
    require_ok(WebPGetFeatures(input.file.data(), input.file.size(), &config.input));
    require_size(static_cast<std::uint64_t>(features.width),
                 static_cast<std::uint64_t>(features.height), input.max_pixels);
    if (features.has_animation != 0) throw Error("the WebP image is an animation, not one image");
    Samples<std::uint8_t> samples{features.width, features.height, 4, {}};
    samples.values.resize(4 * static_cast<std::size_t>(features.width) *
                          static_cast<std::size_t>(features.height));
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {samples.values.data(), 4 * features.width, samples.values.size()};
    require_ok(WebPDecode(input.file.data(), input.file.size(), &config));
    return to_grey(std::move(samples));
}

ImageOrigin webp_origin(const ImageInput& input) {
    const WebPData file{input.file.data(), input.file.size()};
    const std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)> demuxer(WebPDemux(&file),
                                                                           WebPDemuxDelete);
    if (!demuxer) throw Error("the WebP image is cut short or damaged");
    WebPChunkIterator exif{};
    const bool is_found = WebPDemuxGetChunk(demuxer.get(), "EXIF", 1, &exif) != 0;
    const bool is_photo = is_found && is_of_camera({exif.chunk.bytes, exif.chunk.size});
    WebPDemuxReleaseChunkIterator(&exif);
    return {is_photo, std::nullopt};
}

}  // namespace dotpose::images
