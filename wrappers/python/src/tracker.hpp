/// Track for Python, which a Tracker and a Follower give.
#pragma once

#include "binding.hpp"
#include "dotpose/track.hpp"

namespace dotpose::python {

/// Returns the options of a tracker from arguments by their names. Throws TypeError for a name that
/// there is none of.
TrackOptions track_options_of(const py::dict& given);

}  // namespace dotpose::python
