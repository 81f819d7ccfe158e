// Locate: locates a frame with the given options and memory. `Locator` calls these functions.
#pragma once

#include "dotpose/code_evidence.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// See Locator::locate. `prediction` may be null.
Fix locate(const ImageView& image, const DeviceOptions& options, const Prediction* prediction,
           DesktopWorkspace& w);

/// See Locator::locate_in_any_code. `prediction` may be null.
CodeReading locate_in_any_code(const ImageView& image, const DeviceOptions& options,
                               const Prediction* prediction, const CodeEvidence& evidence,
                               DesktopWorkspace& w);

/// See Locator::locate_in_code.
CodeReading locate_in_code(const ImageView& image, const DeviceOptions& options,
                           DesktopWorkspace& w);

}  // namespace dotpose::core
