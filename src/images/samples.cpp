#include "images/samples.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <utility>

namespace dotpose::images {
namespace {

/// Returns the grey level of a pixel with `Channels` samples.
template <int Channels, typename Sample>
std::uint8_t grey_of(const Sample* pixel) {
    constexpr std::uint64_t kFull = std::numeric_limits<Sample>::max();
    constexpr std::uint64_t kLumaScale = 1000;  // sum of the Rec. 601 weights
    constexpr std::uint64_t kScale = kFull * kLumaScale * (kFull / 255);
    const std::uint64_t luma = Channels < 3
                                   ? kLumaScale * pixel[0]
                                   : 299ULL * pixel[0] + 587ULL * pixel[1] + 114ULL * pixel[2];
    const std::uint64_t opacity = Channels % 2 == 0 ? pixel[Channels - 1] : kFull;
    const std::uint64_t on_white = luma * opacity + kFull * kLumaScale * (kFull - opacity);
    return static_cast<std::uint8_t>((on_white + kScale / 2) / kScale);
}

template <int Channels, typename Sample>
GreyImage converted(const Samples<Sample>& samples) {
    GreyImage grey{{}, samples.width_px, samples.height_px};
    grey.pixels.resize(samples.values.size() / Channels);
    const Sample* pixel = samples.values.data();
    for (std::uint8_t& level : grey.pixels) {
        level = grey_of<Channels>(pixel);
        pixel += Channels;
    }
    return grey;
}

template <typename Sample>
GreyImage converted(const Samples<Sample>& samples) {
    switch (samples.channels) {
        case 2:
            return converted<2>(samples);
        case 3:
            return converted<3>(samples);
        case 4:
            return converted<4>(samples);
        default:
            return converted<1>(samples);
    }
}

}  // namespace

GreyImage to_grey(Samples<std::uint8_t> samples) {
    if (samples.channels > 1) return converted(samples);
    return {std::move(samples.values), samples.width_px, samples.height_px};
}

GreyImage to_grey(Samples<std::uint16_t> samples) {
    constexpr std::uint32_t kFull = 65'535;
    const bool is_opaque = samples.channels % 2 == 1;
    const std::uint32_t white = is_opaque && !samples.values.empty()
                                    ? white_level(*std::ranges::max_element(samples.values))
                                    : kFull;
    if (white < kFull) {
        for (std::uint16_t& value : samples.values)
            value = static_cast<std::uint16_t>(value * kFull / white);
    }
    return converted(samples);
}

std::uint32_t white_level(std::uint32_t max_level) {
    constexpr int kMaxBits = 12;
    const int bits = std::max(static_cast<int>(std::bit_width(max_level)), 8);
    return (1U << (bits > kMaxBits ? 16 : bits)) - 1;
}

}  // namespace dotpose::images
