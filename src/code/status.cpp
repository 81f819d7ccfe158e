// Status texts: the name and the message of each status.
#include "dotpose/status.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace dotpose {
namespace {

struct Text {
    Status status;
    const char* name;
    const char* message;
};

// Written by scripts/generate-fields from dotpose/status.hpp.
// clang-format off
constexpr std::array<Text, kStatusCount + 1> kTexts{{
    {Status::ok, "ok",
     "located"},
    {Status::bad_argument, "bad_argument",
     "an option is out of its range, or the image view has no pixels"},
    {Status::image_too_small, "image_too_small",
     "the image is too small to show 8 x 8 dots"},
    {Status::image_too_large, "image_too_large",
     "the image is larger than the memory supports"},
    {Status::no_contrast, "no_contrast",
     "the image has no dark marks on a lighter background"},
    {Status::too_few_dots, "too_few_dots",
     "too few dots"},
    {Status::no_grid, "no_grid",
     "the dots do not form a regular grid"},
    {Status::no_displacement, "no_displacement",
     "the dots are on the grid intersections and carry no symbols"},
    {Status::grid_too_small, "grid_too_small",
     "fewer than 8 x 8 dots of one grid are in view"},
    {Status::not_run, "not_run",
     "no frame has been located yet"},
    {Status::mirrored, "mirrored",
     "the pattern is mirrored"},
    {Status::bad_window, "bad_window",
     "a window must have 6 to 32 columns and rows"},
    {Status::not_in_code, "not_in_code",
     "the position code does not contain the symbols"},
    {Status::ambiguous, "ambiguous",
     "the position code contains the symbols at several places"},
    {Status::not_certain, "not_certain",
     "a position was found, but it may be wrong with more than the allowed probability"},
    {Status::not_tracked, "not_tracked",
     "the pattern is not where it was predicted"},
    {Status::ambiguous_code, "ambiguous_code",
     "places of two codes explain the dots about equally well; name the code, or show more dots"},
    {Status::other, "other",
     "a newer version of dotpose has added this status"},
}};
// clang-format on

constexpr bool in_order() {
    for (std::size_t i = 0; i < kStatusCount; ++i) {
        if (static_cast<std::size_t>(kTexts[i].status) != i) return false;
    }
    return kTexts.back().status == Status::other;
}
static_assert(in_order(), "kTexts has one row per Status, in the order of the values");

/// Returns the index of a status in kTexts. For an unknown value, returns the index of `other`,
/// which is the last index.
constexpr std::size_t row_of(Status status) {
    return std::min<std::size_t>(static_cast<std::size_t>(status), kStatusCount);
}

/// The names are stored separately from the messages, so that device programs that print only names
/// do not link the messages.
constexpr auto kNames = [] {
    std::array<std::array<char, 16>, kTexts.size()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string_view name = kTexts[i].name;
        // Also copies the null terminator.
        std::copy_n(name.data(), name.size() + 1, names[i].begin());
    }
    return names;
}();

}  // namespace

const char* name(Status status) noexcept {
    return kNames[row_of(status)].data();
}
const char* message(Status status) noexcept {
    return kTexts[row_of(status)].message;
}

}  // namespace dotpose
