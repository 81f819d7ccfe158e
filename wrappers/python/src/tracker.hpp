/// The Python class Track, which Tracker and Follower return.
#pragma once

#include "binding.hpp"
#include "dotpose/track.hpp"

namespace dotpose::python {

/// Returns the options of a tracker from keyword arguments. Throws TypeError for an unknown name.
TrackOptions track_options_of(const py::dict& given);

}  // namespace dotpose::python
