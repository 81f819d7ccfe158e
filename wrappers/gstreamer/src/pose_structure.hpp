/// What is known of a frame, as a structure of GStreamer.
#pragma once

#include <gst/gst.h>

#include "stream.hpp"

namespace dotpose::gstreamer {

/// Name of the element's messages and of the custom meta of its buffers.
inline constexpr const char* kPoseName = "dotpose";

/// Sets the fields: names, units and frames are those of the lines of `dotpose watch` with
/// `--units mm` (docs/output.md), numbers are not rounded. What has no value is left out.
void put_reading(GstStructure* structure, const Reading& reading);

}  // namespace dotpose::gstreamer
