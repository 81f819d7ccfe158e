// The dotpose._tools module: files, printing, checking, calibration and drawing. The module is
// optional, because it needs the libraries that the command-line tool uses.
#include "binding.hpp"

PYBIND11_MODULE(_tools, module) {
    using namespace dotpose::python;
    module.doc() = "The tools of dotpose; use the package dotpose.";
    // The classes of _dotpose must be registered before they occur in the signatures of this
    // module.
    py::module_::import("dotpose._dotpose");
    const py::object own_name = module.attr("__name__");
    module.attr("__name__") = "dotpose";
    define_sheets(module);
    define_space(module);
    define_space_tracker(module);
    define_print_map(module);
    define_follower(module);
    define_files(module);
    define_print(module);
    define_check(module);
    define_calibrate(module);
    define_protocol(module);
    define_drawing(module);
    define_camera_files(module);
    module.attr("__name__") = own_name;
}
