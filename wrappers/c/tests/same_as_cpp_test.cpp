// Checks that the functions of dotpose.h return the same results as the functions of the core.
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "convert.hpp"
#include "dotpose.h"
#include "dotpose/frame_pacer.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/track.hpp"

namespace dotpose {
namespace {

struct Destroy {
    void operator()(dotpose_locator* locator) const { dotpose_locator_destroy(locator); }
};
using CLocator = std::unique_ptr<dotpose_locator, Destroy>;

CLocator make_locator(const dotpose_options* options = nullptr) {
    dotpose_options anoto;
    EXPECT_EQ(dotpose_options_init(&anoto, sizeof anoto), DOTPOSE_OK);
    if (options != nullptr) anoto = *options;
    anoto.code = DOTPOSE_CODE_ANOTO;
    dotpose_locator* locator = nullptr;
    EXPECT_EQ(dotpose_locator_create(DOTPOSE_KIND_LARGE, &anoto, &locator), DOTPOSE_OK);
    return CLocator(locator);
}

dotpose_fix locate(dotpose_locator* locator, const GreyImage& image,
                   const dotpose_prediction* prediction = nullptr) {
    dotpose_fix fix;
    EXPECT_EQ(dotpose_fix_init(&fix, sizeof fix), DOTPOSE_OK);
    dotpose_locate(locator, image.pixels.data(), image.width_px, image.height_px, image.width_px,
                   prediction, &fix);
    return fix;
}

dotpose_fix as_c(const Fix& fix) {
    dotpose_fix result;
    EXPECT_EQ(dotpose_fix_init(&result, sizeof result), DOTPOSE_OK);
    c::to_c(fix, result);
    return result;
}

/// Returns true if two structs without padding have the same bits.
template <typename T>
bool same(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Returns the frames of a robot that drives and turns. The middle frame is blank.
std::vector<GreyImage> drive(int frames) {
    Shot shot = draw_shot(Setup{}, 7);
    std::vector<GreyImage> images;
    for (int i = 0; i < frames; ++i) {
        images.push_back(render(shot));
        shot.pose.fraction_x += 0.3;
        shot.pose.fraction_y -= 0.1;
        shot.pose.theta_rad += 0.01;
        ++shot.seed;
    }
    for (std::uint8_t& grey : images[images.size() / 2].pixels)
        grey = 200;
    return images;
}

/// Returns a view of a sheet. At the default size, the view shows six by six cells.
GreyImage small_view_of(const KnownRegion& sheet, int side_px = 66) {
    dotpose::Setup setup;
    setup.camera.width_px = side_px;
    setup.camera.height_px = side_px;
    Shot shot = draw_shot(setup, 3);
    shot.page.pattern.section = sheet.section;
    shot.pose.cell = {sheet.first.x + 100, sheet.first.y + 200};
    return render(shot);
}

/// Returns frames taken at random places on sheets printed in the `libdots` code, which is not the
/// default.
std::vector<GreyImage> libdots_frames(std::uint64_t frames) {
    dotpose::Setup setup;
    setup.pattern.code = CodeVariant::libdots;
    std::vector<GreyImage> images;
    for (std::uint64_t i = 0; i < frames; ++i)
        images.push_back(render(draw_shot(setup, i)));
    return images;
}

/// Expects that a C locator in caller-provided memory returns the same fix as the core locator, for
/// a frame of the given size.
template <int Width, int Height>
void expect_same_device(int kind, dotpose_status (*init)(void*, std::size_t, const dotpose_options*,
                                                         dotpose_locator**)) {
    dotpose::Setup setup;
    setup.camera.width_px = Width;
    setup.camera.height_px = Height;
    const GreyImage image = render(draw_shot(setup, 4));
    DeviceMemoryFor<Width, Height> device_memory;
    const Fix expected = DeviceLocator(device_memory).locate(image.view());
    ASSERT_EQ(expected.status, Status::ok);
    std::vector<std::uint64_t> memory(dotpose_locator_bytes(kind) / 8 + 1);
    dotpose_locator* locator = nullptr;
    ASSERT_EQ(init(memory.data(), 8 * memory.size(), nullptr, &locator), DOTPOSE_OK);
    EXPECT_TRUE(same(locate(locator, image), as_c(expected)));
    dotpose_fix fix;
    ASSERT_EQ(dotpose_fix_init(&fix, sizeof fix), DOTPOSE_OK);
    EXPECT_EQ(dotpose_locate(locator, image.pixels.data(), Width + 1, 64, Width + 1, nullptr, &fix),
              DOTPOSE_IMAGE_TOO_LARGE);
    dotpose_locator_destroy(locator);
    ASSERT_EQ(dotpose_locator_create(kind, nullptr, &locator), DOTPOSE_OK);
    EXPECT_TRUE(same(locate(locator, image), as_c(expected)));
    dotpose_locator_destroy(locator);
}

TEST(C, DevicesOfEverySizeLocateAsThoseOfCpp) {
    expect_same_device<160, 120>(DOTPOSE_KIND_DEVICE_160X120, dotpose_device_160x120_init);
    expect_same_device<188, 120>(DOTPOSE_KIND_DEVICE, dotpose_device_init);
    expect_same_device<320, 240>(DOTPOSE_KIND_DEVICE_320X240, dotpose_device_320x240_init);
}

TEST(C, GivesTheSymbolsOfTheCodePastTheEndsOfItsAxes) {
    constexpr int kColumns = 150;
    constexpr int kRows = 70;
    Rng rng(3);
    for (int n = 0; n < 30; ++n) {
        const auto code = static_cast<CodeVariant>(n % kCodeVariantCount);
        const auto near_end = [&] { return kPositionsPerAxis - 1 - rng.below(200); };
        const bool is_far = n % 2 == 0;
        const Place place{
            {is_far ? rng.below(kPositionsPerAxis) : near_end(),
             is_far ? rng.below(kPositionsPerAxis) : near_end()},
            {static_cast<std::uint8_t>(rng.below(63)), static_cast<std::uint8_t>(rng.below(63))}};
        dotpose_place first;
        c::to_c(place, first);
        std::vector<std::uint8_t> symbols(kColumns * kRows);
        ASSERT_EQ(dotpose_symbols(n % 3, &first, kColumns, kRows, symbols.data(), symbols.size()),
                  DOTPOSE_OK);
        for (int row = 0; row < kRows; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                const Place at = moved(code, place, column, row);
                const Symbol symbol = symbol_at(code, at.cell, at.section);
                ASSERT_EQ(symbols[static_cast<std::size_t>(row * kColumns + column)],
                          static_cast<std::uint8_t>(symbol))
                    << column << ", " << row;
                std::int32_t x = 9;
                std::int32_t y = 9;
                dotpose_place where;
                c::to_c(at, where);
                ASSERT_EQ(dotpose_displacement(n % 3, &where, &x, &y), DOTPOSE_OK);
                ASSERT_EQ(x, dx(symbol));
                ASSERT_EQ(y, dy(symbol));
            }
        }
    }
}

TEST(C, PassesEveryOption) {
    dotpose_options given;
    dotpose_options_init(&given, sizeof given);
    given = {given.size, 1, 0, 0, 0.6, -1e-5, 11, -12, 13, -14, 1e-6, 0.2, 200, 50, 1, 300};
    LocatorOptions read;
    ASSERT_EQ(c::to_core(&given, read), DOTPOSE_OK);
    EXPECT_EQ(read.code, CodeVariant::libdots);
    EXPECT_EQ(read.effort, Effort::device);
    EXPECT_EQ(read.decoder, Decoder::window);
    EXPECT_EQ(read.spacing_mm, 0.6);
    EXPECT_EQ(read.lens_k_per_px2, -1e-5);
    EXPECT_EQ(read.lens_centre_dx_px, 11);
    EXPECT_EQ(read.lens_centre_dy_px, -12);
    EXPECT_EQ(read.reference_dx_px, 13);
    EXPECT_EQ(read.reference_dy_px, -14);
    EXPECT_EQ(read.max_p_wrong, 1e-6);
    EXPECT_EQ(read.max_bit_errors, 0.2);
    EXPECT_EQ(read.bits_per_error, 300);
    EXPECT_EQ(read.min_contrast, 200);
    EXPECT_EQ(read.min_dots, 50);
    EXPECT_TRUE(read.show_stages);
}

TEST(C, HasTheDefaultsOfTheCore) {
    dotpose_options given;
    dotpose_options_init(&given, sizeof given);
    const LocatorOptions core;
    EXPECT_EQ(given.code, DOTPOSE_CODE_DETECT);
    EXPECT_EQ(given.effort, static_cast<std::int32_t>(core.effort));
    EXPECT_EQ(given.decoder, static_cast<std::int32_t>(core.decoder));
    EXPECT_EQ(given.spacing_mm, core.spacing_mm);
    EXPECT_EQ(given.max_p_wrong, core.max_p_wrong);
    EXPECT_EQ(given.max_bit_errors, core.max_bit_errors);
    EXPECT_EQ(given.bits_per_error, core.bits_per_error);
    EXPECT_EQ(given.min_contrast, core.min_contrast);
    EXPECT_EQ(given.min_dots, core.min_dots);
    EXPECT_EQ(given.show_stages, 0);
}

TEST(C, TellsMillimetres) {
    dotpose_options options;
    dotpose_options_init(&options, sizeof options);
    options.spacing_mm = 0.6;
    const CLocator locator = make_locator(&options);
    const GreyImage image = drive(3)[0];
    const dotpose_fix fix = locate(locator.get(), image);
    ASSERT_EQ(fix.status, DOTPOSE_OK);
    EXPECT_NEAR(fix.x_mm, 0.6 * (fix.cell_x + fix.fraction_x_q16 / 65536.0), 1e-6);
    EXPECT_NEAR(fix.y_mm, 0.6 * (fix.cell_y + fix.fraction_y_q16 / 65536.0), 1e-6);
    EXPECT_NEAR(fix.theta_rad, fix.theta_bam / 2147483648.0 * 3.14159265358979, 1e-12);
    EXPECT_FLOAT_EQ(fix.covariance[0], 0.36F * fix.covariance_grid[0]);
    EXPECT_FLOAT_EQ(fix.covariance[5], 0.6F * fix.covariance_grid[5]);
    EXPECT_FLOAT_EQ(fix.covariance[8], fix.covariance_grid[8]);
    EXPECT_DOUBLE_EQ(fix.p_wrong, std::ldexp(1, fix.p_wrong_log2));
    options.spacing_mm = 0;
    dotpose_set_options(locator.get(), &options);
    const dotpose_fix unknown = locate(locator.get(), image);
    EXPECT_TRUE(std::isnan(unknown.x_mm) && std::isnan(unknown.covariance[0]));
    EXPECT_EQ(unknown.covariance_grid[0], fix.covariance_grid[0]);
}

TEST(C, KeepsAFixWhole) {
    const auto memory = std::make_unique<LargeMemory>();
    for (const GreyImage& image : drive(4)) {
        const dotpose_fix fix = as_c(Locator(*memory, DeviceOptions{}).locate(image.view()));
        Fix back;
        ASSERT_EQ(c::to_core(&fix, back), DOTPOSE_OK);
        EXPECT_TRUE(same(as_c(back), fix) || fix.status != DOTPOSE_OK);
    }
}

TEST(C, FollowsARobotAsTheTrackerDoes) {
    const auto memory = std::make_unique<LargeMemory>();
    Locator core(*memory, DeviceOptions{});
    Tracker core_tracker;
    const CLocator locator = make_locator();
    dotpose_tracker tracker;
    ASSERT_EQ(dotpose_tracker_init(&tracker, nullptr), DOTPOSE_OK);
    std::optional<Prediction> expected;
    dotpose_prediction prediction{};
    std::int64_t time_us = 0;
    int tracked = 0;
    for (const GreyImage& image : drive(30)) {
        const Fix core_fix =
            expected ? core.locate(image.view(), *expected) : core.locate(image.view());
        const dotpose_fix fix = locate(locator.get(), image, expected ? &prediction : nullptr);
        const bool is_ok = fix.status == DOTPOSE_OK;
        ASSERT_TRUE(same(fix, as_c(core_fix)) || !is_ok);
        const Sighting core_seen = is_ok ? sighting_of(core_fix, time_us) : Sighting{};
        dotpose_sighting seen;
        if (is_ok) {
            ASSERT_EQ(dotpose_sighting_of(&fix, time_us, &seen), DOTPOSE_OK);
        }
        const Track& core_track = core_tracker.update(time_us, is_ok ? &core_seen : nullptr);
        dotpose_track track;
        ASSERT_EQ(dotpose_tracker_update(&tracker, time_us, is_ok ? &seen : nullptr, &track),
                  DOTPOSE_OK);
        EXPECT_EQ(track.x_nm, core_track.pose.x_nm);
        EXPECT_EQ(track.y_nm, core_track.pose.y_nm);
        EXPECT_EQ(track.x_mm, core_track.pose.x_mm());
        EXPECT_EQ(track.theta_bam, core_track.pose.theta_bam);
        EXPECT_EQ(track.plane, core_track.pose.plane);
        EXPECT_EQ(track.vx_mm_s, core_track.pose.vx_mm_s);
        EXPECT_EQ(track.turn_rad_s, core_track.pose.turn_rad_s);
        EXPECT_EQ(track.covariance[7], core_track.pose.covariance[1][1]);
        EXPECT_EQ(track.covariance[2], core_track.pose.covariance[0][2]);
        EXPECT_EQ(track.verdict, static_cast<std::int32_t>(core_track.verdict));
        EXPECT_EQ(track.is_lost != 0, core_track.is_lost);
        EXPECT_EQ((track.events & DOTPOSE_EVENT_FIX) != 0, core_track.events.fix);
        EXPECT_EQ((track.events & DOTPOSE_EVENT_LOST) != 0, core_track.events.lost);
        EXPECT_EQ((track.events & DOTPOSE_EVENT_STATIONARY) != 0, core_track.events.stationary);
        time_us += 5000;
        expected.reset();
        if (!is_ok) continue;
        expected = core_tracker.predict(time_us, core_fix, core_seen, core.options());
        ASSERT_EQ(
            dotpose_tracker_predict(&tracker, time_us, &fix, &seen, locator.get(), &prediction),
            DOTPOSE_OK);
        dotpose_prediction core_prediction;
        c::to_c(*expected, core_prediction);
        EXPECT_TRUE(same(prediction, core_prediction));
        tracked += fix.attempt == DOTPOSE_ATTEMPT_TRACKED ? 1 : 0;
    }
    EXPECT_GT(tracked, 20);
}

TEST(C, MovesPredictions) {
    const auto memory = std::make_unique<LargeMemory>();
    const Fix fix = Locator(*memory, DeviceOptions{}).locate(drive(3)[0].view());
    const Prediction expected = moved(Prediction::like(fix), CodeVariant::libdots,
                                      {70'000, -90'000}, 1 << 24, {24'000, 15'000});
    const dotpose_fix given = as_c(fix);
    dotpose_prediction prediction;
    ASSERT_EQ(dotpose_prediction_like(&given, &prediction), DOTPOSE_OK);
    ASSERT_EQ(dotpose_prediction_move(&prediction, DOTPOSE_CODE_LIBDOTS, 70'000, -90'000, 1 << 24,
                                      24'000, 15'000),
              DOTPOSE_OK);
    dotpose_prediction core_prediction;
    c::to_c(expected, core_prediction);
    EXPECT_TRUE(same(prediction, core_prediction));
}

TEST(C, SendsAndReadsPackets) {
    const auto memory = std::make_unique<LargeMemory>();
    PacketReader core_reader;
    dotpose_packet_reader reader;
    ASSERT_EQ(dotpose_packet_reader_init(&reader), DOTPOSE_OK);
    std::uint16_t sequence = 65534;
    int completed = 0;
    for (const GreyImage& image : drive(5)) {
        const Fix fix = Locator(*memory, DeviceOptions{}).locate(image.view());
        const PacketBytes expected =
            encode(make_packet(fix, CodeVariant::microdots, ++sequence, 99));
        const dotpose_fix given = as_c(fix);
        dotpose_packet packet;
        ASSERT_EQ(dotpose_packet_of(&given, DOTPOSE_CODE_MICRODOTS, sequence, 99, &packet),
                  DOTPOSE_OK);
        PacketBytes bytes;
        ASSERT_EQ(dotpose_packet_encode(&packet, bytes.data(), bytes.size()), DOTPOSE_OK);
        EXPECT_EQ(bytes, expected);
        for (const std::uint8_t byte : bytes) {
            dotpose_packet read{};
            const bool is_complete = core_reader.push(byte);
            ASSERT_EQ(dotpose_packet_reader_push(&reader, byte, &read),
                      is_complete ? DOTPOSE_OK : DOTPOSE_NO_PACKET);
            if (!is_complete) continue;
            ++completed;
            EXPECT_TRUE(same(read, packet));
        }
    }
    EXPECT_EQ(completed, 5);
}

TEST(C, PacesFramesAsThePacerDoes) {
    const auto memory = std::make_unique<LargeMemory>();
    const GreyImage image = drive(3)[0];
    const Fix fix = Locator(*memory, DeviceOptions{}).locate(image.view());
    const dotpose_fix given = as_c(fix);
    dotpose_pacer_options options;
    dotpose_pacer_options_init(&options, sizeof options);
    options.stationary_after_us = 3'000'000;
    dotpose_pacer pacer;
    ASSERT_EQ(dotpose_pacer_init(&pacer, &options), DOTPOSE_OK);
    FramePacer core({.stationary_after_us = 3'000'000});
    int rests = 0;
    for (std::int64_t time_us = 0; time_us < 6'000'000; time_us += 500'000) {
        std::int64_t next_us = 0;
        std::int32_t is_moving = 7;
        ASSERT_EQ(dotpose_pacer_next_frame(&pacer, &given, time_us, &next_us, &is_moving),
                  DOTPOSE_OK);
        EXPECT_EQ(next_us, core.next_frame_us(fix, time_us));
        EXPECT_EQ(is_moving != 0, core.motion() == Motion::moving);
        rests += is_moving == 0 ? 1 : 0;
    }
    EXPECT_EQ(rests, 6);
}

/// The region of a sheet, as a C struct and as a C++ struct.
constexpr dotpose_region kRegionInC{DOTPOSE_CODE_ANOTO, 0, 0, 0, 1024, 2048, 393, 564};
constexpr KnownRegion kRegion{CodeVariant::anoto, {}, {1024, 2048}, 393, 564};

TEST(C, LocatesSmallViewsOfKnownSheets) {
    Locator core(DeviceOptions{});
    ASSERT_EQ(core.set_known({&kRegion, 1}, OtherSheets::impossible), Status::ok);
    const CLocator locator = make_locator();
    ASSERT_EQ(dotpose_set_known(locator.get(), &kRegionInC, 1, DOTPOSE_OTHERS_IMPOSSIBLE),
              DOTPOSE_OK);
    const GreyImage image = small_view_of(kRegion);
    const Fix expected = core.locate(image.view());
    ASSERT_EQ(expected.status, Status::ok);
    EXPECT_TRUE(same(locate(locator.get(), image), as_c(expected)));
    ASSERT_EQ(dotpose_set_known(locator.get(), nullptr, 0, DOTPOSE_OTHERS_POSSIBLE), DOTPOSE_OK);
    EXPECT_NE(locate(locator.get(), image).status, DOTPOSE_OK);
}

TEST(C, DevicesLocateViewsOfKnownSheets) {
    dotpose::DeviceMemory memory;
    dotpose::DeviceLocator core(memory);
    ASSERT_EQ(core.set_known({&kRegion, 1}, OtherSheets::impossible), Status::ok);
    alignas(8) std::array<std::byte, DOTPOSE_DEVICE_BYTES> bytes;
    dotpose_locator* locator = nullptr;
    ASSERT_EQ(dotpose_device_init(bytes.data(), bytes.size(), nullptr, &locator), DOTPOSE_OK);
    ASSERT_EQ(dotpose_set_known(locator, &kRegionInC, 1, DOTPOSE_OTHERS_IMPOSSIBLE), DOTPOSE_OK);
    const GreyImage image = small_view_of(kRegion, 96);
    const Fix expected = core.locate(image.view());
    ASSERT_EQ(expected.status, Status::ok);
    EXPECT_EQ(expected.prior, Prior::only_sheets);
    EXPECT_TRUE(same(locate(locator, image), as_c(expected)));
}

TEST(C, ReadsFramesTogether) {
    dotpose::Setup setup;
    setup.camera.width_px = setup.camera.height_px = 80;
    setup.seed = 5;
    Shot shot = draw_shot(setup, 0);
    shot.pose.theta_rad = 0;
    Locator core(DeviceOptions{});
    const CLocator locator = make_locator();
    const dotpose_measured_motion motion{1.524F, 1.524F, 0, 0.02F, 0.005F};
    int together = 0;
    for (int k = 0; k < 5; ++k) {
        const GreyImage image = render(shot);
        const Fix expected = core.locate(
            image.view(),
            MeasuredMotion{
                .right_mm = 1.524F, .down_mm = 1.524F, .sigma_mm = 0.02F, .sigma_rad = 0.005F});
        dotpose_fix fix;
        dotpose_fix_init(&fix, sizeof fix);
        dotpose_locate_moved(locator.get(), image.pixels.data(), 80, 80, 80, &motion, &fix);
        EXPECT_EQ(fix.status, as_c(expected).status);
        EXPECT_TRUE(!expected || same(fix, as_c(expected)));
        EXPECT_EQ(fix.frames, expected.frames);
        together += expected.frames > 1 ? 1 : 0;
        shot.pose.cell.x += 3;
        shot.pose.cell.y += 3;
    }
    EXPECT_GT(together, 1);
    dotpose_measured_motion bad = motion;
    bad.sigma_mm = -1;
    dotpose_fix fix;
    dotpose_fix_init(&fix, sizeof fix);
    EXPECT_EQ(dotpose_locate_moved(locator.get(), nullptr, 80, 80, 80, &bad, &fix),
              DOTPOSE_NULL_POINTER);
    const std::vector<std::uint8_t> white(80 * 80, 255);
    EXPECT_EQ(dotpose_locate_moved(locator.get(), white.data(), 80, 80, 80, &bad, &fix),
              DOTPOSE_BAD_VALUE);
    EXPECT_EQ(dotpose_locate_moved(locator.get(), white.data(), 80, 80, 80, nullptr, &fix),
              DOTPOSE_NULL_POINTER);
}

TEST(C, FindsTheCodeOfASheet) {
    const auto memory = std::make_unique<LargeMemory>();
    Locator core(*memory, DeviceOptions{});
    CodeEvidence core_evidence;
    const CLocator locator = make_locator();
    dotpose_code_evidence evidence = {{0}};
    for (const GreyImage& image : libdots_frames(12)) {
        const CodeReading expected = core.locate_in_any_code(image.view(), core_evidence);
        core_evidence = expected.evidence;
        dotpose_code_reading reading;
        dotpose_fix fix;
        ASSERT_EQ(dotpose_fix_init(&fix, sizeof fix), DOTPOSE_OK);
        const dotpose_status status = dotpose_locate_any_code(
            locator.get(), image.pixels.data(), image.width_px, image.height_px, image.width_px,
            nullptr, &evidence, &reading, &fix);
        EXPECT_EQ(status, static_cast<dotpose_status>(expected.fix.status));
        EXPECT_EQ(fix.cell_x, expected.fix.cell.x);
        EXPECT_EQ(fix.p_wrong_log2, expected.fix.p_wrong_log2);
        EXPECT_EQ(reading.code, static_cast<std::int32_t>(expected.code));
        EXPECT_EQ(reading.has_other != 0, expected.has_other);
        EXPECT_EQ(reading.other.x, expected.other_cell.x);
        EXPECT_EQ(reading.other.v, expected.other_section.v);
        std::int32_t code = -1;
        float p_wrong = -1;
        ASSERT_EQ(dotpose_code_likeliest(&evidence, &code, &p_wrong), DOTPOSE_OK);
        EXPECT_EQ(code, static_cast<std::int32_t>(core_evidence.likeliest()));
        EXPECT_EQ(p_wrong, core_evidence.p_wrong(core_evidence.likeliest()));
        const CodeReading in_code = core.locate_in_code(image.view());
        dotpose_locate_in_code(locator.get(), image.pixels.data(), image.width_px, image.height_px,
                               image.width_px, &reading, &fix);
        EXPECT_EQ(fix.fraction_x_q16, in_code.fix.fraction_x_q16);
        EXPECT_EQ(reading.has_other != 0, in_code.has_other);
    }
    EXPECT_EQ(core_evidence.likeliest(), CodeVariant::libdots);
}

TEST(C, DetectsTheCodeByDefault) {
    dotpose_locator* created = nullptr;
    ASSERT_EQ(dotpose_locator_create(DOTPOSE_KIND_LARGE, nullptr, &created), DOTPOSE_OK);
    const CLocator locator(created);
    const auto memory = std::make_unique<LargeMemory>();
    Locator core(*memory, DeviceOptions{});
    CodeEvidence evidence;
    for (const GreyImage& image : libdots_frames(12)) {
        const CodeReading expected = core.locate_in_any_code(image.view(), evidence);
        evidence = expected.evidence;
        EXPECT_TRUE(same(locate(locator.get(), image), as_c(expected.fix)));
        std::int32_t code = -1;
        ASSERT_EQ(dotpose_code_of(locator.get(), &code), DOTPOSE_OK);
        EXPECT_EQ(code, static_cast<std::int32_t>(expected.code));
    }
    EXPECT_EQ(evidence.likeliest(), CodeVariant::libdots);
}

TEST(C, GivesTheDots) {
    dotpose_options options;
    dotpose_options_init(&options, sizeof options);
    options.show_stages = 1;
    const CLocator locator = make_locator(&options);
    const GreyImage image = drive(3)[0];
    locate(locator.get(), image);
    LocatorOptions core_options;
    core_options.show_stages = true;
    const auto memory = std::make_unique<LargeMemory>();
    Locator core(*memory, core_options);
    static_cast<void>(core.locate(image.view()));
    const std::span<const DetectedDot> expected = core.trace().dots;
    std::array<dotpose_dot, 400> dots{};
    std::int32_t count = 0;
    ASSERT_EQ(dotpose_dots(locator.get(), dots.data(), 100, &count), DOTPOSE_OK);
    EXPECT_EQ(count, static_cast<std::int32_t>(expected.size()));
    ASSERT_GT(count, 110);
    EXPECT_EQ(dots[100].mass, 0) << "no more than were asked for";
    ASSERT_EQ(dotpose_dots(locator.get(), dots.data(), 400, &count), DOTPOSE_OK);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(dots[i].u_px * 256, static_cast<float>(expected[i].centre_q8.x));
        EXPECT_EQ(dots[i].v_px * 256, static_cast<float>(expected[i].centre_q8.y));
        EXPECT_EQ(dots[i].mass, expected[i].mass);
        EXPECT_EQ(dots[i].area_px, expected[i].area_px);
    }
}

}  // namespace
}  // namespace dotpose
