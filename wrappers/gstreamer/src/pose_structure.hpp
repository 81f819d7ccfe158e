/// Converts the result for a frame to a GStreamer structure.
#pragma once

#include <gst/gst.h>

#include "stream.hpp"

namespace dotpose::gstreamer {

/// Name used for the messages that the element posts and for the custom meta that it attaches to
/// buffers.
inline constexpr const char* kPoseName = "dotpose";

/// Sets the fields of a reading. Names, units and frames of reference are the same as in the output
/// of `dotpose watch --units mm` (docs/output.md), but numbers are not rounded. Fields without a
/// value are omitted.
void put_reading(GstStructure* structure, const Reading& reading);

}  // namespace dotpose::gstreamer
