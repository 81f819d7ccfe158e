/// The `dotposelocate` element.
#pragma once

#include <gst/gst.h>

namespace dotpose::gstreamer {

gboolean register_element(GstPlugin* plugin);

}  // namespace dotpose::gstreamer
