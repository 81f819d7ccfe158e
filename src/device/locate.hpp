// Locate: implements `DeviceLocator` in integer arithmetic. All memory is provided by the caller.
#pragma once

#include "device/workspace.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// See DeviceLocator::locate.
Fix locate_as_device(const ImageView& image, const DeviceOptions& options, DeviceWorkspace& w);
Fix locate_as_device(const ImageView& image, const DeviceOptions& options,
                     const Prediction& prediction, DeviceWorkspace& w);

/// See DeviceLocator::begin.
Status begin(int width_px, int height_px, const DeviceOptions& options, DeviceWorkspace& w);
Status begin(int width_px, int height_px, const DeviceOptions& options,
             const Prediction& prediction, DeviceWorkspace& w);

void push_row(const std::uint8_t* pixels, const DeviceOptions& options, DeviceWorkspace& w);

/// See DeviceLocator::finish.
const Fix& finish_as_device(const DeviceOptions& options, DeviceWorkspace& w);

}  // namespace dotpose::core
