/// Properties of the element.
#pragma once

#include <string>

#include <glib-object.h>

#include "dotpose/tools/follower.hpp"

namespace dotpose::gstreamer {

/// Properties that may be changed between frames.
struct Switches {
    bool is_inverted = false;    ///< true if dots are white on black
    bool posts_messages = true;  ///< true to post a message on the bus for each frame
    bool attaches_meta = true;   ///< true to attach a meta to each buffer
};

struct Settings {
    std::string sheets;        ///< path of the sheet file, or empty for none
    std::string camera;        ///< path of the camera file, or empty for none
    FollowerOptions options;   ///< follower options, except those determined by the files
    bool is_tracked = true;    ///< false to locate each frame independently
    bool has_overlay = false;  ///< true to draw dots and pose on the frames
    Switches switches;
};

void install_properties(GObjectClass* element_class);

/// Sets or gets a property. Returns false if there is no property with this id.
bool set_property(Settings& settings, guint id, const GValue* value);
bool get_property(const Settings& settings, guint id, GValue* value);

}  // namespace dotpose::gstreamer
