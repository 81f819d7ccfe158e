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

/// Names and messages of the statuses that exist only in the C interface. The index is the status
/// minus kFirst.
constexpr std::array<Text, DOTPOSE_NO_PACKET - kFirst + 1> kTexts{{
    {"null_pointer", "a required pointer is null"},
    {"not_aligned", "the address of the memory is not a multiple of 8"},
    {"too_little_memory", "the memory is too small"},
    {"out_of_memory", "the system has no memory left"},
    {"not_initialized", "the object was not initialized, or was destroyed"},
    {"bad_size", "the size of the struct matches no version: initialize the struct first"},
    {"bad_value", "an argument is out of its range"},
    {"bad_stride", "the rows of the image overlap"},
    {"wrong_kind", "this kind of locator does not support the call"},
    {"no_frame", "no frame was begun, or all its rows were pushed"},
    {"no_fix", "a fix with the status ok is required"},
    {"no_packet", "no packet is complete yet"},
}};

constexpr bool is_of_c(dotpose_status status) {
    return status >= kFirst && status <= DOTPOSE_NO_PACKET;
}

/// Converts a status of dotpose.h to a status of the core. Unknown statuses become `other`.
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
