#include "dotpose/status.hpp"

#include <array>

#include "dotpose.h"
#include "dotpose/version.hpp"

namespace {

struct Text {
    const char* name;
    const char* message;
};

constexpr dotpose_status kFirst = DOTPOSE_NULL_POINTER;

/// Statuses that only the functions for C have; indexed by the status, counted from the first.
constexpr std::array<Text, DOTPOSE_NO_PACKET - kFirst + 1> kTexts{{
    {"null_pointer", "a pointer that must not be null is"},
    {"not_aligned", "the memory does not begin at a multiple of 8"},
    {"too_little_memory", "the memory is smaller than what is needed"},
    {"out_of_memory", "the system has no memory left"},
    {"not_initialized", "the object was not initialized, or is destroyed"},
    {"bad_size", "the size of the struct is that of no version: initialize it first"},
    {"bad_value", "an argument is out of its range"},
    {"bad_stride", "the rows of the image overlap"},
    {"wrong_kind", "this kind of locator cannot do that"},
    {"no_frame", "no frame was begun, or all its rows were pushed"},
    {"no_fix", "the fix that is needed is not ok"},
    {"no_packet", "no packet is complete yet"},
}};

constexpr bool is_of_c(dotpose_status status) {
    return status >= kFirst && status <= DOTPOSE_NO_PACKET;
}

/// Returns the status of the core: `other` for those that it does not have.
dotpose::Status of_core(dotpose_status status) {
    const bool is_known = status >= 0 && status < dotpose::kStatusCount;
    return is_known ? static_cast<dotpose::Status>(status) : dotpose::Status::other;
}

constexpr const Text& of_c(dotpose_status status) {
    return kTexts[static_cast<std::size_t>(status - kFirst)];
}

}  // namespace

extern "C" {

const char* dotpose_status_name(dotpose_status status) {
    return is_of_c(status) ? of_c(status).name : name(of_core(status));
}

const char* dotpose_status_message(dotpose_status status) {
    return is_of_c(status) ? of_c(status).message : message(of_core(status));
}

const char* dotpose_version(void) {
    return DOTPOSE_VERSION;
}
}
