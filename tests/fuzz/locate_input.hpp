// Input format of `locate_fuzz`: a header, followed by pixels or by the symbols of drawn dots.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::fuzz {

/// Header of an input, in native byte order. All values are permitted.
struct LocateHeader {
    enum Flag : std::uint8_t {
        default_options = 1,
        window_decoder = 2,
        one_attempt = 4,
        drawn = 8,  ///< the input contains the symbols of dots instead of pixels
        rows_pushed = 16,
        own_prediction = 32,  ///< the prediction is the fix of the frame plus a displacement
    };
    std::uint16_t width_px = 64;  ///< taken modulo 512
    std::uint16_t height_px = 64;
    std::uint8_t code = 0;  ///< taken modulo 3
    std::uint8_t flags = default_options;
    std::uint8_t padding_px = 0;
    std::int8_t max_p_wrong_log2 = -30;
    std::int16_t max_bit_error_q8 = 46;
    std::int16_t low_q8 = 120;
    std::int16_t high_q8 = 155;
    std::int16_t min_contrast = 8;
    std::int16_t min_area_px = 2;
    std::int16_t min_mass_q8 = 72;
    std::int16_t max_area_ratio = 5;
    std::int16_t min_dots = 40;
    std::int32_t max_offset_q16 = 24000;
    std::int32_t k_q40 = 0;
    std::int32_t reference_dx_q8 = 0;  ///< taken modulo 2^20, which is 4096 px
    std::int32_t reference_dy_q8 = 0;
    // Parameters of drawn dots.
    std::uint16_t angle = 0;             ///< 65536 is a full turn
    std::uint16_t spacing_q8 = 8 * 256;  ///< in px (values below 4 px are treated as 4 px)
};
static_assert(sizeof(LocateHeader) == 44 && std::is_trivially_copyable_v<LocateHeader>);

inline DeviceOptions options_of(const LocateHeader& header) {
    constexpr std::int32_t kFarthest_q8 = 1 << 20;
    DeviceOptions options;
    options.code = static_cast<CodeVariant>(header.code % 3);
    if ((header.flags & LocateHeader::one_attempt) != 0) options.effort = Effort::once;
    if ((header.flags & LocateHeader::window_decoder) != 0) options.decoder = Decoder::window;
    if ((header.flags & LocateHeader::default_options) != 0) return options;
    options.lens.k_q40 = header.k_q40;
    options.threshold = {header.low_q8, header.high_q8, header.min_contrast};
    options.blobs = {header.min_area_px, header.min_mass_q8, header.max_area_ratio};
    options.lattice = {header.min_dots, header.max_offset_q16};
    options.integrity = {header.max_p_wrong_log2, header.max_bit_error_q8};
    options.reference_dx_q8 = header.reference_dx_q8 % kFarthest_q8;
    options.reference_dy_q8 = header.reference_dy_q8 % kFarthest_q8;
    return options;
}

/// If the `own_prediction` flag is set and the frame has a fix, returns this fix, displaced by up
/// to 2 spacings and rotated by up to 11 degrees. Otherwise, returns an arbitrary prediction, which
/// is read from the last bytes of the input. These bytes also serve as pixels.
inline Prediction prediction_of(const LocateHeader& header, std::span<const std::uint8_t> rest,
                                const Fix& fix) {
    static_assert(std::is_trivially_copyable_v<Prediction>);
    Prediction prediction;
    if (rest.size() >= sizeof prediction) {
        std::memcpy(&prediction, &rest[rest.size() - sizeof prediction], sizeof prediction);
    }
    if ((header.flags & LocateHeader::own_prediction) == 0 || fix.status != Status::ok) {
        return prediction;
    }
    const FixedVec by = prediction.pattern_from_image.at_centre_q16;
    constexpr std::int32_t kFarthest_q16 = 1 << 17;
    constexpr std::int32_t kLargestTurn_bam = 1 << 27;
    return moved(Prediction::like(fix), options_of(header).code,
                 {by.x % kFarthest_q16, by.y % kFarthest_q16},
                 prediction.pattern_from_image.lens_q40 % kLargestTurn_bam,
                 prediction.pattern_from_image.centre_q8);
}

/// An image whose last pixel is at the end of its allocation, so that a sanitizer detects reads
/// past the image.
struct Pixels {
    std::vector<std::uint8_t> bytes;
    int width_px = 0;
    int height_px = 0;
    std::ptrdiff_t stride_bytes = 0;

    Pixels(const LocateHeader& header, std::uint8_t level)
        : width_px(header.width_px % 512),
          height_px(header.height_px % 512),
          stride_bytes(width_px + header.padding_px) {
        if (height_px == 0) return;
        bytes.assign(static_cast<std::size_t>(stride_bytes * (height_px - 1) + width_px), level);
        bytes.shrink_to_fit();
    }
    ImageView view() const { return {bytes.data(), width_px, height_px, stride_bytes}; }
    std::uint8_t& at(int u, int v) { return bytes[static_cast<std::size_t>(stride_bytes * v + u)]; }
};

/// Number of symbols per row, and number of rows, in drawn images. Cell (0, 0) is in the middle.
inline constexpr int kDrawnSide = 40;

/// Draws one dot per symbol. The diameter is one sixth of the spacing plus 1 px. If the byte of a
/// symbol is 240 or more, no dot is drawn.
inline void draw_dots(const LocateHeader& header, std::span<const std::uint8_t> symbols,
                      Pixels& image) {
    const double spacing = std::max(header.spacing_q8 / 256.0, 4.0);
    const double angle = header.angle * 6.283185307179586 / 65536;
    const double radius = spacing / 12 + 0.5;
    for (std::size_t n = 0; n < symbols.size(); ++n) {
        if (symbols[n] >= 240) continue;
        const auto symbol = static_cast<Symbol>(symbols[n] & 3);
        const auto index = static_cast<int>(n);
        const double x = index % kDrawnSide - kDrawnSide / 2 + dx(symbol) / 6.0;
        const double y = index / kDrawnSide - kDrawnSide / 2 + dy(symbol) / 6.0;
        const double u0 =
            image.width_px / 2.0 + spacing * (x * std::cos(angle) - y * std::sin(angle));
        const double v0 =
            image.height_px / 2.0 + spacing * (x * std::sin(angle) + y * std::cos(angle));
        for (int v = static_cast<int>(v0 - radius); v <= static_cast<int>(v0 + radius) + 1; ++v) {
            for (int u = static_cast<int>(u0 - radius); u <= static_cast<int>(u0 + radius) + 1;
                 ++u) {
                if (u < 0 || v < 0 || u >= image.width_px || v >= image.height_px) continue;
                const double cover =
                    std::clamp(radius - std::hypot(u - u0, v - v0) + 0.5, 0.0, 1.0);
                image.at(u, v) = static_cast<std::uint8_t>(image.at(u, v) * (1 - 0.8 * cover));
            }
        }
    }
}

/// Returns the image of a fuzz input. If the `drawn` flag is set, `rest` contains the symbols of a
/// pattern to draw. Otherwise, `rest` contains grey values, row by row, and is repeated until the
/// image is full. If `rest` is empty, the image is blank paper.
inline Pixels pixels_of(const LocateHeader& header, std::span<const std::uint8_t> rest) {
    constexpr std::uint8_t kPaper = 200;
    Pixels image(header, kPaper);
    if ((header.flags & LocateHeader::drawn) != 0) {
        constexpr std::size_t kMaxSymbols = std::size_t{kDrawnSide} * kDrawnSide;
        draw_dots(header, rest.first(std::min(rest.size(), kMaxSymbols)), image);
    } else if (!rest.empty()) {
        std::size_t from = 0;
        for (int v = 0; v < image.height_px; ++v) {
            for (int u = 0; u < image.width_px; ++u) {
                image.at(u, v) = rest[from];
                from = from + 1 == rest.size() ? 0 : from + 1;
            }
        }
    }
    return image;
}

}  // namespace dotpose::fuzz
