// Functions in the `_tools` module: reading and writing camera files, and `with_camera`, which
// computes the pose of a mounted camera. Camera.read, Camera.write and Locator call these
// functions.
#include "camera_files.hpp"

#include "dotpose/files/camera_file.hpp"
#include "dotpose/tools/mounted_pose.hpp"

namespace dotpose::python {

void define_camera_files(py::module_& module) {
    module.def("_read_camera", &read_camera, "path"_a);
    module.def(
        "_write_camera",
        [](const std::filesystem::path& path, const Camera& camera) { write_camera(path, camera); },
        "path"_a, "camera"_a);
    static constexpr WithCamera kWithCamera = [](const Fix& fix, const Camera& camera,
                                                 const Trace& trace) {
        return with_camera(fix, camera, trace);
    };
    module.attr("_with_camera") = py::capsule(&kWithCamera, "dotpose.with_camera");
}

}  // namespace dotpose::python
