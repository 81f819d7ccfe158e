// The dotpose._dotpose module: classes and functions for locating, tracking and simulation. The
// package dotpose re-exports its contents.
#include "binding.hpp"
#include "dotpose/version.hpp"

PYBIND11_MODULE(_dotpose, module) {
    using namespace dotpose::python;
    module.doc() = "The compiled part of dotpose; use the package dotpose.";
    // Users import the classes from the package `dotpose`, so the classes must report `dotpose` as
    // their module. The module is therefore renamed while the classes are defined.
    const py::object own_name = module.attr("__name__");
    module.attr("__name__") = "dotpose";
    module.attr("__version__") = DOTPOSE_VERSION;
    define_errors(module);
    define_options(module);
    define_fix(module);
    define_camera(module);
    define_measured_motion(module);
    define_locator(module);
    define_tracker(module);
    define_simulate(module);
    module.attr("__name__") = own_name;
}
