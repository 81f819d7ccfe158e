// Locating a frame with memory and options that are given: the body of Locator and DeviceLocator.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

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
