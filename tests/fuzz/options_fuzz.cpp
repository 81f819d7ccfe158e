// Fuzzes the options of `locate` on frames that can be located. `locate` must terminate, and a fix
// must be within the limits of the options. An input is a list of changes to the default options.
// Each change consists of the index of a field and its new value.
#include <array>
#include <cstring>
#include <memory>

#include "dotpose/tools/simulate.hpp"
#include "locate_checks.hpp"

namespace {

using namespace dotpose;

/// The index of a field and its new value, in native byte order.
struct Change {
    std::uint8_t field = 0;
    std::int32_t value = 0;
};
constexpr std::size_t kChangeBytes = 5;

void apply(const Change& change, DeviceOptions& options) {
    const std::array<std::int32_t*, 17> numbers = {&options.lens.k_q40,
                                                   &options.lens.centre_dx_q8,
                                                   &options.lens.centre_dy_q8,
                                                   &options.threshold.low_q8,
                                                   &options.threshold.high_q8,
                                                   &options.threshold.min_contrast,
                                                   &options.blobs.min_area_px,
                                                   &options.blobs.min_mass_q8,
                                                   &options.blobs.max_area_ratio,
                                                   &options.lattice.min_dots,
                                                   &options.lattice.max_offset_q16,
                                                   &options.integrity.max_p_wrong_log2,
                                                   &options.integrity.max_bit_error_q8,
                                                   &options.integrity.bits_per_error,
                                                   &options.max_dots,
                                                   &options.reference_dx_q8,
                                                   &options.reference_dy_q8};
    const auto byte = static_cast<std::uint8_t>(change.value);
    const std::size_t field = change.field % (numbers.size() + 4);
    if (field < numbers.size()) {
        *numbers[field] = change.value;
    } else if (field == numbers.size()) {
        options.code = static_cast<CodeVariant>(byte);
    } else if (field == numbers.size() + 1) {
        options.effort = static_cast<Effort>(byte);
    } else if (field == numbers.size() + 2) {
        options.decoder = static_cast<Decoder>(byte);
    } else {
        options.show_stages = (byte & 1) != 0;
    }
}

std::array<GreyImage, 3> make_frames() {
    std::array<GreyImage, 3> frames;
    for (std::uint64_t i = 0; i < frames.size(); ++i) {
        Setup setup;
        setup.preset = i == 0 ? Preset::clean : Preset::hard;
        setup.camera.width_px = setup.camera.height_px = 96;
        setup.camera.mm_per_px = kDefaultSpacing_mm / 8;
        frames[i] = render(draw_shot(setup, i));
    }
    return frames;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto kMemory = std::make_unique<LargeMemory>();
    static const std::array<GreyImage, 3> kFrames = make_frames();
    if (size < 1) return -1;
    const ImageView image = kFrames[data[0] % kFrames.size()].view();
    DeviceOptions options;
    for (std::size_t at = 1; at + kChangeBytes <= size; at += kChangeBytes) {
        Change change{data[at]};
        std::memcpy(&change.value, data + at + 1, sizeof change.value);
        apply(change, options);
    }
    const Fix usual = Locator(*kMemory, DeviceOptions{}).locate(image);
    Locator locator(*kMemory, options);
    fuzz::check(locator.locate(image), options);
    fuzz::check(locator.locate(image, Prediction::like(usual)), options);
    if (options.effort == Effort::once) fuzz::check(fuzz::push_rows(image, locator), options);
    return 0;
}
