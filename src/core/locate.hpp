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

/// See Locator::locate_in_any_code; without a prediction, null.
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

/// One attempt with the rows that were pushed; with `finish_as_device` in integers.
Fix finish(const Options& options, Workspace& w);
const Fix& finish_as_device(const Options& options, Workspace& w);

/// The fix of a frame that is not looked at; nothing of the frame before is shown beside it.
const Fix& refuse(Status reason, Workspace& w);

}  // namespace dotpose::core
