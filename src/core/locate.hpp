// Locating a frame with memory and options that are given: the body of Locator and DeviceLocator.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <type_traits>

#include "core/workspace.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// Makes the workspace in the bytes of a Memory.
template <typename Space, std::size_t Bytes>
Workspace* make_workspace(std::array<std::byte, Bytes>& bytes) {
    static_assert(sizeof(Space) <= Bytes, "Memory::kBytes is too small");
    static_assert(std::is_trivially_destructible_v<Space>, "nothing destroys it");
    return ::new (static_cast<void*>(bytes.data())) Space;
}

/// Returns ok if a frame can be begun, or an image located, otherwise the reason.
Status check(int width_px, int height_px, const Options& options, const Workspace& w);
Status check(const ImageView& image, const Options& options, const Workspace& w);

/// See Locator::locate.
Fix locate(const ImageView& image, const Options& options, Workspace& w);
Fix locate(const ImageView& image, const Options& options, const Prediction& prediction,
           Workspace& w);

/// See Locator::locate_in_any_code; `prediction` may be null.
CodeReading locate_in_any_code(const ImageView& image, const Options& options,
                               const Prediction* prediction, const CodeEvidence& evidence,
                               Workspace& w);

/// See Locator::locate_in_code.
CodeReading locate_in_code(const ImageView& image, const Options& options, Workspace& w);

/// See DeviceLocator::locate.
Fix locate_as_device(const ImageView& image, const Options& options, Workspace& w);
Fix locate_as_device(const ImageView& image, const Options& options, const Prediction& prediction,
                     Workspace& w);

/// See Locator::begin.
Status begin(int width_px, int height_px, const Options& options, Workspace& w);
Status begin(int width_px, int height_px, const Options& options, const Prediction& prediction,
             Workspace& w);

void push_row(const std::uint8_t* pixels, const Options& options, Workspace& w);

/// Locates the frame whose rows were pushed, in one attempt; `finish_as_device` does so in
/// integers.
Fix finish(const Options& options, Workspace& w);
const Fix& finish_as_device(const Options& options, Workspace& w);

/// Sets and returns the fix of a frame that is refused before any stage; results of the frame
/// before are cleared.
const Fix& refuse(Status reason, Workspace& w);

}  // namespace dotpose::core
