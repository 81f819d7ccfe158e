// Locates frames with a locator of any kind.
#include <algorithm>

#include "locator.hpp"

namespace dotpose::c {

dotpose_status check(const dotpose_locator* locator) {
    if (locator == nullptr) return DOTPOSE_NULL_POINTER;
    const auto address = reinterpret_cast<std::uintptr_t>(locator);
    if (address % alignof(dotpose_locator) != 0) return DOTPOSE_NOT_INITIALIZED;
    return locator->mark == kLocatorMark ? DOTPOSE_OK : DOTPOSE_NOT_INITIALIZED;
}

void drop_frame(dotpose_locator& locator) {
    locator.rows_left = 0;
    locator.has_begun = false;
}

dotpose_status read_image(const std::uint8_t* pixels, std::int32_t width_px, std::int32_t height_px,
                          std::ptrdiff_t stride_bytes, Frame& frame) {
    if (pixels == nullptr) return DOTPOSE_NULL_POINTER;
    // The stride matters only if there are several rows. The core refuses images without pixels.
    const bool has_rows = width_px > 0 && height_px > 1;
    if (has_rows && stride_bytes > -width_px && stride_bytes < width_px) return DOTPOSE_BAD_STRIDE;
    frame.image = {pixels, width_px, height_px, stride_bytes};
    return DOTPOSE_OK;
}

dotpose_status read_prediction(const dotpose_prediction* given, Frame& frame) {
    if (given == nullptr) return DOTPOSE_OK;
    frame.expected = &frame.prediction;
    return to_core(*given, frame.prediction);
}

}  // namespace dotpose::c

using namespace dotpose;

extern "C" {

dotpose_status dotpose_set_known(dotpose_locator* locator, const dotpose_region* regions,
                                 size_t count, int32_t others) {
    const dotpose_status status = c::check(locator);
    if (status != DOTPOSE_OK) return status;
    if (regions == nullptr && count != 0) return DOTPOSE_NULL_POINTER;
    if (!c::is_one_of(others, OtherSheets::impossible)) return DOTPOSE_BAD_VALUE;
    c::drop_frame(*locator);
    const std::span known{reinterpret_cast<const KnownRegion*>(regions), count};
    const Status set =
        locator->actions->set_known(*locator->locator, known, static_cast<OtherSheets>(others));
    return set == Status::ok ? DOTPOSE_OK : DOTPOSE_BAD_VALUE;
}

dotpose_status dotpose_set_options(dotpose_locator* locator, const dotpose_options* given) {
    dotpose_status status = c::check(locator);
    if (status != DOTPOSE_OK) return status;
    LocatorOptions options;
    status = c::to_core(given, options);
    if (status != DOTPOSE_OK) return status;
    c::drop_frame(*locator);
    locator->actions->set_options(*locator->locator, options);
    return DOTPOSE_OK;
}

dotpose_status dotpose_locate(dotpose_locator* locator, const uint8_t* pixels, int32_t width_px,
                              int32_t height_px, ptrdiff_t stride_bytes,
                              const dotpose_prediction* prediction, dotpose_fix* fix) {
    dotpose_status status = c::check(fix);
    if (status != DOTPOSE_OK) return status;
    status = c::check(locator);
    if (status != DOTPOSE_OK) return c::refuse(status, *fix);
    c::drop_frame(*locator);
    c::Frame frame;
    status = c::read_image(pixels, width_px, height_px, stride_bytes, frame);
    if (status == DOTPOSE_OK) status = c::read_prediction(prediction, frame);
    if (status != DOTPOSE_OK) return c::refuse(status, *fix);
    c::to_c(locator->actions->locate(*locator->locator, frame.image, frame.expected), *fix);
    return fix->status;
}

dotpose_status dotpose_code_of(const dotpose_locator* locator, int32_t* code) {
    if (code == nullptr) return DOTPOSE_NULL_POINTER;
    const dotpose_status status = c::check(locator);
    if (status != DOTPOSE_OK) return status;
    *code = static_cast<std::int32_t>(locator->locator->options().code);
    return DOTPOSE_OK;
}

dotpose_status dotpose_begin(dotpose_locator* locator, int32_t width_px, int32_t height_px,
                             const dotpose_prediction* prediction) {
    dotpose_status status = c::check(locator);
    if (status != DOTPOSE_OK) return status;
    c::drop_frame(*locator);
    c::Frame frame;
    status = c::read_prediction(prediction, frame);
    if (status != DOTPOSE_OK) return status;
    const Status begun =
        locator->actions->begin(*locator->locator, width_px, height_px, frame.expected);
    locator->has_begun = true;
    if (begun == Status::ok) locator->rows_left = height_px;
    return static_cast<dotpose_status>(begun);
}

dotpose_status dotpose_push_row(dotpose_locator* locator, const uint8_t* pixels) {
    const dotpose_status status = c::check(locator);
    if (status != DOTPOSE_OK) return status;
    if (pixels == nullptr) return DOTPOSE_NULL_POINTER;
    if (locator->rows_left == 0) return DOTPOSE_NO_FRAME;
    --locator->rows_left;
    locator->actions->push_row(*locator->locator, pixels);
    return DOTPOSE_OK;
}

dotpose_status dotpose_finish(dotpose_locator* locator, dotpose_fix* fix) {
    dotpose_status status = c::check(fix);
    if (status != DOTPOSE_OK) return status;
    status = c::check(locator);
    if (status != DOTPOSE_OK) return c::refuse(status, *fix);
    if (!locator->has_begun) return c::refuse(DOTPOSE_NO_FRAME, *fix);
    c::drop_frame(*locator);
    c::to_c(locator->actions->finish(*locator->locator), *fix);
    return fix->status;
}
}
