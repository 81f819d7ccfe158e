// Tests the options that are given in millimetres, pixels or ratios: their units, their ranges, and
// their effect in each attempt.
#include "dotpose/locator_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../core/canvas.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::core_test::locator_options_test {
namespace {

Shot shot(Preset preset, std::uint64_t index, CodeVariant code = CodeVariant::anoto) {
    Setup setup;
    setup.preset = preset;
    setup.seed = 77;
    setup.pattern.code = code;
    return draw_shot(setup, index);
}

GreyImage frame(std::uint64_t index, Preset preset = Preset::nominal) {
    return render(shot(preset, index));
}

LocatorOptions with_contrast(int min_contrast) {
    LocatorOptions options;
    options.code = CodeVariant::anoto;
    options.min_contrast = min_contrast;
    return options;
}

LargeMemory& memory() {
    static const auto kMemory = std::make_unique<LargeMemory>();
    return *kMemory;
}

TEST(LocatorOptions, AreConvertedToFixedPoint) {
    const DeviceOptions defaults = LocatorOptions{};
    EXPECT_EQ(defaults.spacing_nm, 508'000);
    EXPECT_EQ(defaults.integrity.max_p_wrong_log2, -30) << "2^-30 is the largest power below 1e-9";
    EXPECT_EQ(defaults.integrity.max_bit_error_q8, 46);
    EXPECT_EQ(defaults.integrity.bits_per_error, 0);
    EXPECT_EQ(defaults.lattice.min_dots, 40);
    EXPECT_EQ(defaults.effort, Effort::twice);
    EXPECT_EQ(defaults.decoder, Decoder::all);
    LocatorOptions given;
    given.code = CodeVariant::microdots;
    given.spacing_mm = 0.6;
    given.lens_k_per_px2 = -0x1p-20;
    given.lens_centre_dx_px = 1.5;
    given.lens_centre_dy_px = -2;
    given.reference_dx_px = 20.25;
    given.reference_dy_px = -3;
    given.max_p_wrong = 0x1p-40;
    given.max_bit_errors = 0.5;
    given.bits_per_error = 1000;
    given.min_contrast = 12;
    given.min_dots = 50;
    given.show_stages = true;
    const DeviceOptions fixed = given;
    EXPECT_EQ(fixed.code, CodeVariant::microdots);
    EXPECT_EQ(fixed.spacing_nm, 600'000);
    EXPECT_EQ(fixed.lens.k_q40, -(1 << 20));
    EXPECT_EQ(fixed.lens.centre_dx_q8, 384);
    EXPECT_EQ(fixed.lens.centre_dy_q8, -512);
    EXPECT_EQ(fixed.reference_dx_q8, 5184);
    EXPECT_EQ(fixed.reference_dy_q8, -768);
    EXPECT_EQ(fixed.integrity.max_p_wrong_log2, -40);
    EXPECT_EQ(fixed.integrity.max_bit_error_q8, 128);
    EXPECT_EQ(fixed.integrity.bits_per_error, 1000);
    EXPECT_EQ(fixed.min_contrast, 12);
    EXPECT_EQ(fixed.lattice.min_dots, 50);
    EXPECT_TRUE(fixed.show_stages);
}

TEST(LocatorOptions, ABadOneIsNamedAndRefused) {
    struct Case {
        const char* name;
        std::function<void(LocatorOptions&, double)> set;
        double low;
        double high;
    };
#define MEMBER(member) #member, [](LocatorOptions & o, double value) { o.member = value; }
    const std::vector<Case> cases{
        {MEMBER(spacing_mm), 0, 1000},
        {MEMBER(lens_k_per_px2), -0.00195, 0.00195},
        {MEMBER(lens_centre_dx_px), -1024, 1024},
        {MEMBER(lens_centre_dy_px), -1024, 1024},
        {MEMBER(reference_dx_px), -16384, 16384},
        {MEMBER(reference_dy_px), -16384, 16384},
        {MEMBER(max_p_wrong), 1e-300, 1},
        {MEMBER(max_bit_errors), 0, 1},
        {"bits_per_error",
         [](LocatorOptions& o, double v) { o.bits_per_error = static_cast<int>(v); }, -1, 65536},
        {"min_contrast", [](LocatorOptions& o, double v) { o.min_contrast = static_cast<int>(v); },
         0, 255},
        {"min_dots", [](LocatorOptions& o, double v) { o.min_dots = static_cast<int>(v); }, 0,
         1 << 20},
    };
#undef MEMBER
    const GreyImage image = frame(0);
    const auto expect = [&](const LocatorOptions& options, const char* bad) {
        EXPECT_STREQ(bad_option(options), bad);
        const Status status = Locator(memory(), options).locate(image.view()).status;
        EXPECT_EQ(status == Status::bad_argument, bad != nullptr) << (bad ? bad : "");
    };
    for (const auto& [name, set, low, high] : cases) {
        SCOPED_TRACE(name);
        LocatorOptions options = with_contrast(0);
        set(options, low);
        expect(options, nullptr);
        set(options, high);
        expect(options, nullptr);
        set(options, low == 1e-300 ? 0 : low - 1);
        expect(options, name);
        set(options, high + 1);
        expect(options, name);
    }
    for (double LocatorOptions::*member :
         {&LocatorOptions::spacing_mm, &LocatorOptions::max_p_wrong,
          &LocatorOptions::max_bit_errors, &LocatorOptions::reference_dx_px}) {
        LocatorOptions options = with_contrast(0);
        options.*member = std::numeric_limits<double>::quiet_NaN();
        EXPECT_NE(bad_option(options), nullptr);
    }
    LocatorOptions options;
    options.code = static_cast<CodeVariant>(3);
    expect(options, "code");
    options = {};
    options.effort = static_cast<Effort>(3);
    expect(options, "effort");
    options = {};
    options.decoder = static_cast<Decoder>(2);
    expect(options, "decoder");
}

TEST(LocatorOptions, TheCodeIsDetectedUnlessItIsGiven) {
    for (const CodeVariant code :
         {CodeVariant::anoto, CodeVariant::libdots, CodeVariant::microdots}) {
        Locator locator;
        Fix fix;
        for (std::uint64_t i = 0; i < 4; ++i)
            fix = locator.locate(render(shot(Preset::nominal, i, code)).view());
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_EQ(locator.options().code, code);
        const Shot last = shot(Preset::nominal, 3, code);
        EXPECT_EQ(fix.cell.x, static_cast<std::uint32_t>(std::floor(x_grid(last.pose))));
        const Fix tracked = locator.locate(render(last).view(), Prediction::like(fix));
        EXPECT_EQ(tracked.attempt, Attempt::tracked);
        EXPECT_EQ(tracked.cell, fix.cell);
        // After new options are set without a code, the code must be detected again.
        locator.set_options(LocatorOptions{});
        EXPECT_EQ(locator.options().code, CodeVariant::anoto);
        EXPECT_EQ(locator.locate(render(last).view()).status, Status::ok);
    }
    Locator given({.code = CodeVariant::anoto});
    EXPECT_NE(given.locate(render(shot(Preset::nominal, 3, CodeVariant::microdots)).view()).status,
              Status::ok);
}

/// Returns the frame with its contrast multiplied by `by`. The grey level 128 does not change.
GreyImage paled(GreyImage image, double by) {
    for (std::uint8_t& grey : image.pixels)
        grey = static_cast<std::uint8_t>(std::lround(128 + by * (grey - 128)));
    return image;
}

/// Returns the contrast between the paper and the darkest parts of dots, in grey levels.
int contrast_of(const GreyImage& image) {
    std::vector<std::uint8_t> greys = image.pixels;
    std::sort(greys.begin(), greys.end());
    return greys[greys.size() / 2] - greys[greys.size() / 100];
}

Fix pushed(const GreyImage& image, const LocatorOptions& options) {
    Locator locator(memory(), options);
    EXPECT_EQ(locator.begin(image.width_px, image.height_px), Status::ok);
    for (int v = 0; v < image.height_px; ++v)
        locator.push_row(image.view().row(v));
    return locator.finish();
}

/// A function that locates a frame with the given options.
using Way = std::function<Fix(const GreyImage&, const LocatorOptions&)>;

/// Expects an attempt to locate a frame if the minimum contrast is 0 or a third of the frame's
/// contrast, and to report no_contrast if the minimum contrast is twice the frame's contrast.
void expect_contrast_counts(const Way& locate, const GreyImage& image, Attempt attempt) {
    const int contrast = contrast_of(image);
    ASSERT_GT(contrast, 15);
    for (const int demanded : {0, contrast / 3}) {
        const Fix fix = locate(image, with_contrast(demanded));
        ASSERT_EQ(fix.status, Status::ok) << "of " << contrast << " demanded " << demanded;
        EXPECT_EQ(fix.attempt, attempt);
    }
    EXPECT_EQ(locate(image, with_contrast(std::min(2 * contrast, 255))).status,
              Status::no_contrast);
}

TEST(MinContrast, RefusesPaleFramesInTheFirstAttempt) {
    const Way locate = [](const GreyImage& image, const LocatorOptions& options) {
        return Locator(memory(), options).locate(image.view());
    };
    for (std::uint64_t i = 0; i < 5; ++i)
        expect_contrast_counts(locate, paled(frame(i), 0.3), Attempt::first);
}

TEST(MinContrast, RefusesPaleFramesInTheTrackedAttempt) {
    const Way locate = [](const GreyImage& image, const LocatorOptions& options) {
        const Fix before = Locator(memory(), with_contrast(0)).locate(image.view());
        return Locator(memory(), options).locate(image.view(), Prediction::like(before));
    };
    for (std::uint64_t i = 0; i < 5; ++i)
        expect_contrast_counts(locate, paled(frame(i), 0.3), Attempt::tracked);
}

TEST(MinContrast, RefusesPaleFramesInTheSecondAttempt) {
    const Way locate = [](const GreyImage& image, const LocatorOptions& options) {
        return Locator(memory(), options).locate(image.view());
    };
    int frames = 0;
    for (std::uint64_t i = 0; i < 200 && frames < 3; ++i) {
        const GreyImage image = frame(i, Preset::hard);
        const Fix fix = locate(image, with_contrast(0));
        if (fix.status != Status::ok || fix.attempt != Attempt::second) continue;
        ++frames;
        EXPECT_EQ(locate(image, with_contrast(1)).attempt, Attempt::second);
        EXPECT_EQ(locate(image, with_contrast(250)).status, Status::no_contrast);
    }
    EXPECT_EQ(frames, 3);
}

TEST(MinContrast, RefusesPaleFramesWhoseCodeIsDetected) {
    const Way locate = [](const GreyImage& image, LocatorOptions options) {
        options.code = std::nullopt;
        return Locator(memory(), options).locate(image.view());
    };
    for (std::uint64_t i = 0; i < 5; ++i)
        expect_contrast_counts(locate, paled(frame(i), 0.3), Attempt::first);
}

TEST(MinContrast, RefusesPaleRows) {
    int frames = 0;
    for (std::uint64_t i = 0; i < 10 && frames < 5; ++i) {
        const GreyImage image = paled(frame(i), 0.3);
        if (pushed(image, with_contrast(0)).status != Status::ok) continue;
        ++frames;
        EXPECT_EQ(pushed(image, with_contrast(contrast_of(image) / 3)).status, Status::ok);
        EXPECT_EQ(pushed(image, with_contrast(2 * contrast_of(image))).status, Status::no_contrast);
    }
    EXPECT_EQ(frames, 5);
}

TEST(MinContrast, RefusesPaleFramesOnDevices) {
    const auto device = std::make_unique<DeviceMemory>();
    int frames = 0;
    for (std::uint64_t i = 0; i < 20 && frames < 5; ++i) {
        // A DeviceLocator tracks only dots that are darker than three quarters of the paper level,
        // so the frame must not be too pale.
        const GreyImage image = paled(frame(i), 0.7);
        DeviceOptions options;
        const Fix fix = DeviceLocator(*device, options).locate(image.view());
        if (fix.status != Status::ok) continue;
        const Prediction prediction = Prediction::like(fix);
        const auto status = [&](int min_contrast) {
            options.min_contrast = min_contrast;
            return DeviceLocator(*device, options).locate(image.view()).status;
        };
        const auto tracked = [&](int min_contrast) {
            options.min_contrast = min_contrast;
            return DeviceLocator(*device, options).locate(image.view(), prediction);
        };
        if (tracked(0).attempt != Attempt::tracked) continue;
        ++frames;
        const int contrast = contrast_of(image);
        EXPECT_EQ(status(contrast / 3), Status::ok);
        EXPECT_EQ(status(std::min(2 * contrast, 255)), Status::no_contrast);
        EXPECT_EQ(tracked(contrast / 3).attempt, Attempt::tracked);
        EXPECT_EQ(tracked(std::min(2 * contrast, 255)).status, Status::no_contrast);
    }
    EXPECT_EQ(frames, 5);
}

}  // namespace
}  // namespace dotpose::core_test::locator_options_test
