// The body of DeviceLocator: locates a frame with given memory and options.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// See DeviceLocator::locate.
Fix locate_as_device(const ImageView& image, const Options& options, Workspace& w);
Fix locate_as_device(const ImageView& image, const Options& options, const Prediction& prediction,
                     Workspace& w);

/// See DeviceLocator::begin.
Status begin(int width_px, int height_px, const Options& options, Workspace& w);
Status begin(int width_px, int height_px, const Options& options, const Prediction& prediction,
             Workspace& w);

void push_row(const std::uint8_t* pixels, const Options& options, Workspace& w);

/// See DeviceLocator::finish.
const Fix& finish_as_device(const Options& options, Workspace& w);

}  // namespace dotpose::core
