/// Options of the Python classes Tracker and Follower.
#pragma once

#include "binding.hpp"
#include "dotpose/track.hpp"

namespace dotpose::python {

/// Converts keyword arguments to tracker options. Throws TypeError for an unknown name.
TrackOptions track_options_of(const py::dict& given);

}  // namespace dotpose::python
