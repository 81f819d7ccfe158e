// The plugin descriptor, which GStreamer reads from the shared library.
#include <array>

#include <gst/gst.h>

#include "dotpose/version.hpp"
#include "element.hpp"
#include "pose_structure.hpp"

namespace {

gboolean register_all(GstPlugin* plugin) {
    // The meta has no tags, so GStreamer keeps it when another element scales or converts the
    // frame.
    std::array<const char*, 1> no_tags = {nullptr};
    if (gst_meta_register_custom(dotpose::gstreamer::kPoseName, no_tags.data(), nullptr, nullptr,
                                 nullptr) == nullptr) {
        return FALSE;
    }
    return dotpose::gstreamer::register_element(plugin);
}

}  // namespace

GST_PLUGIN_DEFINE(GST_VERSION_MAJOR, GST_VERSION_MINOR, dotpose,
                  "Locates a camera on a sheet printed with a dot position code", register_all,
                  DOTPOSE_VERSION, "MIT/X11", "dotpose", "https://example.org/dotpose")
