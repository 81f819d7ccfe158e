/// The words in which lines, panels and messages tell what a tracker says.
#pragma once

#include <string>

#include "dotpose/track.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Returns "lost", "stationary" or "moving".
std::string state_name(const Track& track);

/// Returns the names of what happened, with spaces in between; empty if nothing did.
std::string event_names(const TrackEvents& events);

}  // namespace dotpose

#pragma GCC visibility pop
