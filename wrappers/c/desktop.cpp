// Functions that device locators do not support: code detection, and access to the dots of the last
// frame.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

#include "dotpose/code_evidence.hpp"
#include "dotpose/known_region.hpp"
#include "locator.hpp"

namespace {

using namespace dotpose;

/// Layout of CodeEvidence in the core (dotpose/code_evidence.hpp). `log2_q8` contains the log2 odds
/// of each code, from the frames at earlier places. `factors` contains, for each code, the sum of
/// the likelihood ratios over the frames at the current place. `x` and `y` are the coordinates of
/// the cell of the first frame at this place, and `frames` is the number of frames at this place.
struct State {
    std::int32_t log2_q8[kCodeVariantCount];
    float factors[kCodeVariantCount];
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t frames;
};
static_assert(sizeof(State) == sizeof(dotpose_code_evidence));
static_assert(sizeof(State) == sizeof(CodeEvidence));
static_assert(std::is_trivially_copyable_v<CodeEvidence>);

/// Reads evidence. Null means no evidence. Returns BAD_VALUE if the struct was neither zeroed nor
/// written by this library.
dotpose_status read_evidence(const dotpose_code_evidence* given, CodeEvidence& evidence) {
    if (given == nullptr) return DOTPOSE_OK;
    State state;
    std::memcpy(&state, given, sizeof state);
    constexpr std::int32_t kMin_q8 = -256 * CodeEvidence::kMax_log2;
    constexpr float kMax = 0x1p64F;
    const bool is_sound =
        std::all_of(std::begin(state.log2_q8), std::end(state.log2_q8),
                    [](std::int32_t log2) { return log2 >= kMin_q8 && log2 <= 0; }) &&
        std::all_of(std::begin(state.factors), std::end(state.factors), [&](float factors) {
            return factors >= static_cast<float>(state.frames) && factors <= kMax;
        });
    if (!is_sound || state.x >= kPositionsPerAxis || state.y >= kPositionsPerAxis)
        return DOTPOSE_BAD_VALUE;
    std::memcpy(static_cast<void*>(&evidence), given, sizeof evidence);
    return DOTPOSE_OK;
}

// The core reads the regions in the caller's memory without conversion, so the layouts must be
// equal.
static_assert(sizeof(dotpose_region) == sizeof(KnownRegion));
static_assert(offsetof(dotpose_region, code) == offsetof(KnownRegion, code));
static_assert(offsetof(dotpose_region, section_u) == offsetof(KnownRegion, section.u));
static_assert(offsetof(dotpose_region, section_v) == offsetof(KnownRegion, section.v));
static_assert(offsetof(dotpose_region, first_x) == offsetof(KnownRegion, first.x));
static_assert(offsetof(dotpose_region, first_y) == offsetof(KnownRegion, first.y));
static_assert(offsetof(dotpose_region, columns) == offsetof(KnownRegion, columns));
static_assert(offsetof(dotpose_region, rows) == offsetof(KnownRegion, rows));

void give(const CodeReading& reading, dotpose_code_reading* result) {
    if (result == nullptr) return;
    result->code = static_cast<std::int32_t>(reading.code);
    result->has_other = reading.has_other ? 1 : 0;
    result->other_code = static_cast<std::int32_t>(reading.other_code);
    c::to_c(Place{reading.other_cell, reading.other_section}, result->other);
}

/// Returns OK if the locator is valid and not a device locator.
dotpose_status check_desktop(const dotpose_locator* locator) {
    const dotpose_status status = c::check(locator);
    if (status != DOTPOSE_OK) return status;
    return locator->actions->locate_in_code == nullptr ? DOTPOSE_WRONG_KIND : DOTPOSE_OK;
}

}  // namespace

extern "C" {

dotpose_status dotpose_locate_moved(dotpose_locator* locator, const uint8_t* pixels,
                                    int32_t width_px, int32_t height_px, ptrdiff_t stride_bytes,
                                    const dotpose_measured_motion* since_last, dotpose_fix* fix) {
    dotpose_status status = c::check(fix);
    if (status != DOTPOSE_OK) return status;
    status = check_desktop(locator);
    c::Frame frame;
    MeasuredMotion motion;
    if (status == DOTPOSE_OK)
        status = c::read_image(pixels, width_px, height_px, stride_bytes, frame);
    if (status == DOTPOSE_OK && since_last == nullptr) status = DOTPOSE_NULL_POINTER;
    if (status == DOTPOSE_OK) status = c::to_core(*since_last, motion);
    if (status != DOTPOSE_OK) return c::refuse(status, *fix);
    c::drop_frame(*locator);
    c::to_c(locator->actions->locate_moved(*locator->locator, frame.image, motion), *fix);
    return fix->status;
}

dotpose_status dotpose_locate_any_code(dotpose_locator* locator, const uint8_t* pixels,
                                       int32_t width_px, int32_t height_px, ptrdiff_t stride_bytes,
                                       const dotpose_prediction* prediction,
                                       dotpose_code_evidence* evidence,
                                       dotpose_code_reading* reading, dotpose_fix* fix) {
    dotpose_status status = c::check(fix);
    if (status != DOTPOSE_OK) return status;
    status = check_desktop(locator);
    c::Frame frame;
    CodeEvidence before;
    if (status == DOTPOSE_OK)
        status = c::read_image(pixels, width_px, height_px, stride_bytes, frame);
    if (status == DOTPOSE_OK) status = c::read_prediction(prediction, frame);
    if (status == DOTPOSE_OK) status = read_evidence(evidence, before);
    if (status != DOTPOSE_OK) return c::refuse(status, *fix);
    c::drop_frame(*locator);
    const CodeReading read = locator->actions->locate_in_any_code(*locator->locator, frame.image,
                                                                  frame.expected, before);
    if (evidence != nullptr) std::memcpy(evidence, &read.evidence, sizeof *evidence);
    give(read, reading);
    c::to_c(read.fix, *fix);
    return fix->status;
}

dotpose_status dotpose_locate_in_code(dotpose_locator* locator, const uint8_t* pixels,
                                      int32_t width_px, int32_t height_px, ptrdiff_t stride_bytes,
                                      dotpose_code_reading* reading, dotpose_fix* fix) {
    dotpose_status status = c::check(fix);
    if (status != DOTPOSE_OK) return status;
    status = check_desktop(locator);
    c::Frame frame;
    if (status == DOTPOSE_OK)
        status = c::read_image(pixels, width_px, height_px, stride_bytes, frame);
    if (status != DOTPOSE_OK) return c::refuse(status, *fix);
    c::drop_frame(*locator);
    const CodeReading read = locator->actions->locate_in_code(*locator->locator, frame.image);
    give(read, reading);
    c::to_c(read.fix, *fix);
    return fix->status;
}

dotpose_status dotpose_code_likeliest(const dotpose_code_evidence* evidence, int32_t* code,
                                      float* p_wrong) {
    if (evidence == nullptr || code == nullptr || p_wrong == nullptr) return DOTPOSE_NULL_POINTER;
    CodeEvidence read;
    const dotpose_status status = read_evidence(evidence, read);
    if (status != DOTPOSE_OK) return status;
    *code = static_cast<std::int32_t>(read.likeliest());
    *p_wrong = read.p_wrong(read.likeliest());
    return DOTPOSE_OK;
}

dotpose_status dotpose_dots(const dotpose_locator* locator, dotpose_dot* dots, int32_t capacity,
                            int32_t* count) {
    if (count == nullptr || (dots == nullptr && capacity != 0)) return DOTPOSE_NULL_POINTER;
    *count = 0;
    const dotpose_status status = check_desktop(locator);
    if (status != DOTPOSE_OK) return status;
    if (capacity < 0) return DOTPOSE_BAD_VALUE;
    const std::span<const DetectedDot> found = locator->locator->trace().dots;
    *count = static_cast<std::int32_t>(found.size());
    constexpr float kPx_per_q8 = 1.0F / 256;
    for (const DetectedDot& dot :
         found.first(static_cast<std::size_t>(std::min(*count, capacity)))) {
        *dots++ = {static_cast<float>(dot.centre_q8.x) * kPx_per_q8,
                   static_cast<float>(dot.centre_q8.y) * kPx_per_q8, dot.mass, dot.area_px};
    }
    return DOTPOSE_OK;
}
}
