#include "dotpose/status.hpp"

#include <array>

#include "dotpose.h"

namespace {

struct Text {
    const char* name;
    const char* message;
};

constexpr dotpose_status kFirstMisuse = DOTPOSE_NULL_POINTER;

/// Indexed by the status, counted from the first misuse.
constexpr std::array<Text, DOTPOSE_NO_FIX - kFirstMisuse + 1> kMisuses{{
    {"null_pointer", "a pointer that must not be null is"},
    {"not_aligned", "the memory does not begin at a multiple of 8"},
    {"too_little_memory", "the memory is smaller than what is needed"},
    {"out_of_memory", "the system has no memory left"},
    {"not_initialized", "the object was not initialized, or is destroyed"},
    {"bad_size", "the size of the options is that of no version: initialize them first"},
    {"bad_value", "an argument is out of its range"},
    {"bad_stride", "the rows of the image overlap"},
    {"wrong_kind", "this kind of locator cannot do that"},
    {"no_frame", "no frame was begun, or all its rows were pushed"},
    {"no_fix", "the fix that is needed is not ok"},
}};

constexpr bool is_misuse(dotpose_status status) {
    return status >= kFirstMisuse && status <= DOTPOSE_NO_FIX;
}

/// Returns the status of the core; statuses that it does not have become one that has no text.
dotpose::Status of_core(dotpose_status status) {
    return static_cast<dotpose::Status>(status >= 0 && status < dotpose::kStatusCount ? status
                                                                                      : UINT8_MAX);
}

constexpr const Text& misuse(dotpose_status status) {
    return kMisuses[static_cast<std::size_t>(status - kFirstMisuse)];
}

}  // namespace

extern "C" {

const char* dotpose_status_name(dotpose_status status) {
    return is_misuse(status) ? misuse(status).name : name(of_core(status));
}

const char* dotpose_status_message(dotpose_status status) {
    return is_misuse(status) ? misuse(status).message : message(of_core(status));
}

const char* dotpose_version(void) {
    return DOTPOSE_VERSION;
}
}

static_assert(static_cast<int>(dotpose::Status::ok) == DOTPOSE_OK);
static_assert(static_cast<int>(dotpose::Status::not_run) == DOTPOSE_NOT_RUN);
static_assert(static_cast<int>(dotpose::Status::ambiguous_code) == DOTPOSE_AMBIGUOUS_CODE);
static_assert(dotpose::kStatusCount == DOTPOSE_AMBIGUOUS_CODE + 1,
              "dotpose.h names every status of the core");
