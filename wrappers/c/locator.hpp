// Implementation of dotpose_locator. Each object contains a core locator with its memory, and a
// pointer to the function table of its kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

#include "convert.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::c {

/// Functions that differ between kinds of locators. They are called through pointers, so a program
/// links only the kinds that it creates. The last four pointers are null for device locators.
struct Actions {
    void (*set_options)(RowLocator& locator, const LocatorOptions& options);
    Fix (*locate)(RowLocator& locator, const ImageView& image, const Prediction* prediction);
    Status (*begin)(RowLocator& locator, int width_px, int height_px, const Prediction* prediction);
    void (*push_row)(RowLocator& locator, const std::uint8_t* pixels);
    Fix (*finish)(RowLocator& locator);
    Status (*set_known)(RowLocator& locator, std::span<const KnownRegion> regions,
                        OtherSheets others);
    CodeReading (*locate_in_any_code)(RowLocator& locator, const ImageView& image,
                                      const Prediction* prediction, const CodeEvidence& evidence);
    CodeReading (*locate_in_code)(RowLocator& locator, const ImageView& image);
    Fix (*locate_moved)(RowLocator& locator, const ImageView& image, const MeasuredMotion& motion);
};

/// Returns the function pointers for `Kind`, which is Locator or DeviceLocator.
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
    actions.set_known = [](RowLocator& locator, std::span<const KnownRegion> regions,
                           OtherSheets others) {
        return static_cast<Kind&>(locator).set_known(regions, others);
    };
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
        actions.locate_moved = [](RowLocator& locator, const ImageView& image,
                                  const MeasuredMotion& motion) {
            return static_cast<Kind&>(locator).locate(image, motion);
        };
    }
    return actions;
}
template <typename Kind>
inline constexpr Actions kActionsOf = actions_of<Kind>();

/// Value of `mark` in an object that was set up.
inline constexpr std::uint32_t kLocatorMark = 0xD07C0001;

}  // namespace dotpose::c

/// Members common to all kinds of locators, at the beginning of each object.
struct dotpose_locator {
    std::uint32_t mark = 0;
    std::int32_t rows_left = 0;  ///< number of rows of the current frame still to be pushed
    bool has_begun = false;      ///< true if a frame has been begun but not finished
    const dotpose::c::Actions* actions = nullptr;
    dotpose::RowLocator* locator = nullptr;
    void* allocation = nullptr;  ///< memory to be freed by dotpose_locator_destroy, or null
};

namespace dotpose::c {

/// Checks that a locator can be used.
dotpose_status check(const dotpose_locator* locator);
/// Discards the unfinished frame, if there is one.
void drop_frame(dotpose_locator& locator);

/// An image and its prediction, as core types.
struct Frame {
    ImageView image;
    Prediction prediction;
    const Prediction* expected = nullptr;  ///< pointer to `prediction`, or null
};

dotpose_status read_image(const std::uint8_t* pixels, std::int32_t width_px, std::int32_t height_px,
                          std::ptrdiff_t stride_bytes, Frame& frame);
/// Reads a prediction. `given` may be null.
dotpose_status read_prediction(const dotpose_prediction* given, Frame& frame);

/// Required alignment of memory provided by the caller, in bytes.
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

/// Returns the number of bytes needed to place a T in memory that is aligned to kAlignment.
/// Includes padding if T needs a larger alignment.
template <typename T>
constexpr std::size_t bytes_of() {
    return sizeof(T) + (alignof(T) > kAlignment ? alignof(T) - kAlignment : 0);
}

/// Checks memory provided by the caller. The memory must be aligned and have at least `needed`
/// bytes.
inline dotpose_status check_memory(const void* memory, std::size_t bytes, std::size_t needed) {
    if (memory == nullptr) return DOTPOSE_NULL_POINTER;
    if (reinterpret_cast<std::uintptr_t>(memory) % kAlignment != 0) return DOTPOSE_NOT_ALIGNED;
    return bytes < needed ? DOTPOSE_TOO_LITTLE_MEMORY : DOTPOSE_OK;
}

/// Creates a T in memory provided by the caller. T must be a LocatorOf.
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
