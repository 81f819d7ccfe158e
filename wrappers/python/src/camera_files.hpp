/// Function pointer type for passing `with_camera` from the _tools module to _dotpose.
#pragma once

#include "binding.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::python {

/// Type of `with_camera` (dotpose/tools/mounted_pose.hpp), which returns the fix for a camera that
/// is mounted at a fixed height.
using WithCamera = Fix (*)(const Fix& fix, const Camera& camera, const Trace& trace);

}  // namespace dotpose::python
