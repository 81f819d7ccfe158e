/// Declarations shared by the binding files: the namespace `py`, the functions that define the
/// Python API, and conversions of option values.
#pragma once

#include <optional>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "dotpose/code.hpp"
#include "dotpose/locator_options.hpp"

namespace dotpose::python {

namespace py = pybind11;
using namespace py::literals;

/// Each function defines the classes and functions for one subject in the _dotpose module. The
/// functions are called in this order, because signatures refer to classes that must already be
/// defined.
void define_errors(py::module_& module);
void define_options(py::module_& module);
void define_fix(py::module_& module);
void define_camera(py::module_& module);
void define_measured_motion(py::module_& module);
void define_locator(py::module_& module);
void define_tracker(py::module_& module);
void define_simulate(py::module_& module);

/// Each function defines the classes and functions for one subject in the _tools module. The
/// functions are called in this order, because signatures refer to classes that must already be
/// defined.
void define_sheets(py::module_& module);
void define_space(py::module_& module);
void define_space_tracker(py::module_& module);
void define_print_map(py::module_& module);
void define_follower(py::module_& module);
void define_files(py::module_& module);
void define_print(py::module_& module);
void define_check(py::module_& module);
void define_calibrate(py::module_& module);
void define_protocol(py::module_& module);
void define_drawing(py::module_& module);
void define_camera_files(py::module_& module);

/// Imports the _tools module. If the module is not installed, throws ImportError with `wanted` in
/// its message.
py::module_ tools_for(const char* wanted);

/// Returns the options in fixed point. Throws BadArgument if an option is out of range.
DeviceOptions checked(const LocatorOptions& options);

/// Returns the code with the given name, or none for "auto". Throws BadArgument for any other name.
std::optional<CodeVariant> code_or_auto(const std::string& name);
/// Returns the code with the given name. Throws BadArgument for any other name.
CodeVariant code_named(const std::string& name);

}  // namespace dotpose::python
