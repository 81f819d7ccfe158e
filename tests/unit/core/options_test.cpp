// Tests the ranges of options. Values within the range must not cause an overflow in any stage, and
// values outside the range must be refused.
#include <climits>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "canvas.hpp"
#include "dotpose/files/option_names.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/option_fault.hpp"

namespace dotpose::core_test::options_test {
namespace {

GreyImage a_frame() {
    Setup setup;
    setup.seed = 34;
    return render(draw_shot(setup, 0));
}

/// An option and the limits of its range, as documented in device_options.hpp.
struct Range {
    const char* field;
    std::function<void(DeviceOptions&, int)> set;
    std::int64_t low;
    std::int64_t high;
};

#define FIELD(path) #path, [](DeviceOptions & options, int value) { options.path = value; }

const Range kRanges[] = {
    {FIELD(lens.k_q40), INT_MIN, INT_MAX},
    {FIELD(lens.centre_dx_q8), -262144, 262144},
    {FIELD(lens.centre_dy_q8), -262144, 262144},
    {FIELD(threshold.low_q8), 1, 256},
    {FIELD(threshold.high_q8), 1, 256},
    {FIELD(threshold.min_contrast), 1, 255},
    {FIELD(blobs.min_area_px), 0, 1048576},
    {FIELD(blobs.min_mass_q8), 0, 256},
    {FIELD(blobs.max_area_ratio), 1, 1024},
    {FIELD(lattice.min_dots), 0, 1048576},
    {FIELD(min_contrast), 0, 255},
    {FIELD(lattice.max_offset_q16), 0, 32768},
    {FIELD(integrity.max_p_wrong_log2), -1048576, 0},
    {FIELD(integrity.max_bit_error_q8), 0, 256},
    {FIELD(integrity.bits_per_error), -1, 65536},
    {FIELD(max_dots), INT_MIN, INT_MAX},
    {FIELD(spacing_nm), INT_MIN, INT_MAX},
    {FIELD(reference_dx_q8), -4194304, 4194304},
    {FIELD(reference_dy_q8), -4194304, 4194304},
};

#undef FIELD

/// This code does not compile if a field is added to DeviceOptions. The new field must then be
/// added here and to the tests below.
[[maybe_unused]] void has_all_fields(const DeviceOptions& o) {
    [[maybe_unused]] const auto& [code, effort, decoder, lens, threshold, blobs, lattice, integrity,
                                  contrast, max_dots, spacing, show_stages, dx, dy] = o;
    [[maybe_unused]] const auto& [k, centre_dx, centre_dy] = lens;
    [[maybe_unused]] const auto& [low, high, min_contrast] = threshold;
    [[maybe_unused]] const auto& [min_area, min_mass, max_area] = blobs;
    [[maybe_unused]] const auto& [min_dots, max_offset] = lattice;
    [[maybe_unused]] const auto& [max_p_wrong, max_bit_error, bits_per_error] = integrity;
}

/// Expects every function that locates a frame to reject the options if `is_refused` is true, and
/// to accept them otherwise.
void expect_refusal(const DeviceOptions& options, bool is_refused, const char* field, int value) {
    static const auto kMemory = std::make_unique<LargeMemory>();
    static const GreyImage kFrame = a_frame();
    const auto expect = [&](Status status, const char* way) {
        EXPECT_EQ(status == Status::bad_argument, is_refused)
            << way << ": " << field << " = " << value << " gave " << name(status);
    };
    const OptionFault fault = option_fault(options);
    EXPECT_STREQ(fault.name, is_refused ? field : nullptr) << value;
    EXPECT_EQ(fault.value, is_refused ? value : 0) << field;
    const Prediction prediction =
        Prediction::like(Locator(*kMemory, DeviceOptions{}).locate(kFrame.view()));
    expect(Locator(*kMemory, options).locate(kFrame.view()).status, "locate");
    expect(Locator(*kMemory, options).locate(kFrame.view(), prediction).status, "tracked");
    expect(Locator(*kMemory, options).begin(kFrame.width_px, kFrame.height_px), "begin");
    expect(Locator(*kMemory, options).begin(kFrame.width_px, kFrame.height_px, prediction),
           "tracked");
}

TEST(DeviceOptions, EveryNumberIsTakenInItsRangeAndRefusedOutside) {
    for (const Effort effort : kEfforts) {
        for (const auto& [field, set, low, high] : kRanges) {
            for (const std::int64_t value :
                 {low - 1, low, high, high + 1, std::int64_t{INT_MIN}, std::int64_t{INT_MAX}}) {
                if (value < INT_MIN || value > INT_MAX) continue;
                DeviceOptions options;
                options.effort = effort;
                set(options, static_cast<int>(value));
                expect_refusal(options, value < low || value > high, field,
                               static_cast<int>(value));
            }
        }
    }
}

TEST(DeviceOptions, AFaultIsToldWithItsRange) {
    DeviceOptions options;
    EXPECT_EQ(fault_text(options), "");
    options.threshold.low_q8 = 300;
    EXPECT_EQ(fault_text(options), "the option threshold.low_q8 is 300; it must be 1 to 256");
}

TEST(DeviceOptions, EnumerationsAreTakenAsFarAsTheyHaveNames) {
    for (int value = 0; value < 256; ++value) {
        const auto byte = static_cast<std::uint8_t>(value);
        DeviceOptions code;
        code.code = static_cast<CodeVariant>(byte);
        expect_refusal(code, value >= 3, "code", value);
        DeviceOptions effort;
        effort.effort = static_cast<Effort>(byte);
        expect_refusal(effort, value >= static_cast<int>(kEfforts.size()), "effort", value);
        DeviceOptions decoder;
        decoder.decoder = static_cast<Decoder>(byte);
        expect_refusal(decoder, value >= static_cast<int>(kDecoders.size()), "decoder", value);
    }
}

}  // namespace
}  // namespace dotpose::core_test::options_test
