/// The function by which the module _tools gives _dotpose the pose of a mounted camera.
#pragma once

#include "binding.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::python {

/// Returns the fix of a camera that is mounted at a fixed height: see `with_camera`.
using WithCamera = Fix (*)(const Fix& fix, const Camera& camera, const Trace& trace);

}  // namespace dotpose::python
