/// Names of the tracker's states and events, for output lines, panels and messages.
#pragma once

#include <string>

#include "dotpose/export.hpp"
#include "dotpose/track.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Returns "lost", "stationary" or "moving".
std::string state_name(const Track& track);

/// Returns the names of the events, separated by spaces. Returns an empty string if there are
/// no events.
std::string event_names(const TrackEvents& events);

}  // namespace dotpose

DOTPOSE_END_EXPORT
