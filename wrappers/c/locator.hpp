// What stands behind a dotpose_locator: the core's memory and locator, for each kind in one object,
// and the functions that this kind does in its own way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

#include "convert.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::c {

/// What kinds of locators do differently. Pointers, so that a program contains only the kinds that
/// it makes. Devices do not have the last two.
struct Actions {
    void (*set_options)(RowLocator& locator, const LocatorOptions& options);
    Fix (*locate)(RowLocator& locator, const ImageView& image, const Prediction* prediction);
    Status (*begin)(RowLocator& locator, int width_px, int height_px, const Prediction* prediction);
    void (*push_row)(RowLocator& locator, const std::uint8_t* pixels);
    Fix (*finish)(RowLocator& locator);
    CodeReading (*locate_in_any_code)(RowLocator& locator, const ImageView& image,
                                      const Prediction* prediction, const CodeEvidence& evidence);
    CodeReading (*locate_in_code)(RowLocator& locator, const ImageView& image);
};

/// Returns the actions of a Locator or a DeviceLocator.
template <typename Kind>
constexpr Actions actions_of() {
    Actions actions{};
    actions.set_options = [](RowLocator& locator, const LocatorOptions& options) {
        static_cast<Kind&>(locator).set_options(options);
    };
    actions.locate = [](RowLocator& locator, const ImageView& image, const Prediction* prediction) {
        auto& it = static_cast<Kind&>(locator);
        return prediction == nullptr ? it.locate(image) : it.locate(image, *prediction);
    };
    actions.begin = [](RowLocator& locator, int width_px, int height_px,
                       const Prediction* prediction) {
        auto& it = static_cast<Kind&>(locator);
        return prediction == nullptr ? it.begin(width_px, height_px)
                                     : it.begin(width_px, height_px, *prediction);
    };
    actions.push_row = [](RowLocator& locator, const std::uint8_t* pixels) {
        static_cast<Kind&>(locator).push_row(pixels);
    };
    actions.finish = [](RowLocator& locator) { return static_cast<Kind&>(locator).finish(); };
    if constexpr (std::is_same_v<Kind, Locator>) {
        actions.locate_in_any_code = [](RowLocator& locator, const ImageView& image,
                                        const Prediction* prediction,
                                        const CodeEvidence& evidence) {
            auto& it = static_cast<Kind&>(locator);
            return prediction == nullptr ? it.locate_in_any_code(image, evidence)
                                         : it.locate_in_any_code(image, *prediction, evidence);
        };
        actions.locate_in_code = [](RowLocator& locator, const ImageView& image) {
            return static_cast<Kind&>(locator).locate_in_code(image);
        };
    }
    return actions;
}
template <typename Kind>
inline constexpr Actions kActionsOf = actions_of<Kind>();

/// By which an object is recognized that was set up.
inline constexpr std::uint32_t kLocatorMark = 0xD07C0001;

}  // namespace dotpose::c

/// What all kinds have, at the beginning of each.
struct dotpose_locator {
    std::uint32_t mark = 0;
    std::int32_t rows_left = 0;  ///< rows that the frame that was begun still takes
    bool has_begun = false;      ///< whether dotpose_finish has a frame to finish
    const dotpose::c::Actions* actions = nullptr;
    dotpose::RowLocator* locator = nullptr;
    void* allocation = nullptr;  ///< what dotpose_locator_destroy frees, if anything
};

namespace dotpose::c {

/// Whether a locator can be used.
dotpose_status check(const dotpose_locator* locator);
/// Forgets the frame whose rows are pushed.
void drop_frame(dotpose_locator& locator);

/// An image and the prediction for it, as the core takes them.
struct Frame {
    ImageView image;
    Prediction prediction;
    const Prediction* expected = nullptr;  ///< the prediction, if there is one
};

dotpose_status read_image(const std::uint8_t* pixels, std::int32_t width_px, std::int32_t height_px,
                          std::ptrdiff_t stride_bytes, Frame& frame);
/// Reads a prediction, which may be null.
dotpose_status read_prediction(const dotpose_prediction* given, Frame& frame);

/// Callers' memory begins at a multiple of this.
inline constexpr std::size_t kAlignment = 8;

/// A locator of one kind, with its memory.
template <typename Memory, typename Kind>
struct LocatorOf : dotpose_locator {
    explicit LocatorOf(const LocatorOptions& options) : kind(memory, options) {
        mark = kLocatorMark;
        actions = &kActionsOf<Kind>;
        locator = &kind;
    }

    Memory memory;
    Kind kind;
};

/// Returns the bytes of memory that has room for a T wherever it begins.
template <typename T>
constexpr std::size_t bytes_of() {
    return sizeof(T) + (alignof(T) > kAlignment ? alignof(T) - kAlignment : 0);
}

/// Checks memory that a caller gives for an object of this many bytes.
inline dotpose_status check_memory(const void* memory, std::size_t bytes, std::size_t needed) {
    if (memory == nullptr) return DOTPOSE_NULL_POINTER;
    if (reinterpret_cast<std::uintptr_t>(memory) % kAlignment != 0) return DOTPOSE_NOT_ALIGNED;
    return bytes < needed ? DOTPOSE_TOO_LITTLE_MEMORY : DOTPOSE_OK;
}

/// Makes a T, which is a LocatorOf, in memory that a caller gives.
template <typename T>
dotpose_status init(void* memory, std::size_t bytes, const dotpose_options* given,
                    dotpose_locator** result) {
    if (result == nullptr) return DOTPOSE_NULL_POINTER;
    *result = nullptr;
    dotpose_status status = check_memory(memory, bytes, bytes_of<T>());
    if (status != DOTPOSE_OK) return status;
    LocatorOptions options;
    status = to_core(given, options);
    if (status != DOTPOSE_OK) return status;
    const std::size_t skipped = (0 - reinterpret_cast<std::uintptr_t>(memory)) % alignof(T);
    *result = ::new (static_cast<void*>(static_cast<std::byte*>(memory) + skipped)) T(options);
    return DOTPOSE_OK;
}

}  // namespace dotpose::c
