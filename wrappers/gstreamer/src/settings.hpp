/// The properties of the element.
#pragma once

#include <string>

#include <glib-object.h>

#include "dotpose/tools/follower.hpp"

namespace dotpose::gstreamer {

/// Those that may change from frame to frame.
struct Switches {
    bool is_inverted = false;    ///< dots are white on black
    bool posts_messages = true;  ///< on the bus
    bool attaches_meta = true;   ///< to the buffers
};

struct Settings {
    std::string sheets;        ///< path of the sheet file; empty for none
    std::string camera;        ///< path of the camera file; empty for none
    FollowerOptions options;   ///< without the files
    bool is_tracked = true;    ///< false: each frame by itself
    bool has_overlay = false;  ///< dots and pose are drawn on the frames
    Switches switches;
};

void install_properties(GObjectClass* element_class);

/// Return whether there is a property of this number.
bool set_property(Settings& settings, guint id, const GValue* value);
bool get_property(const Settings& settings, guint id, GValue* value);

}  // namespace dotpose::gstreamer
