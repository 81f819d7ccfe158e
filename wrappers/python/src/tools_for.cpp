// Provides access to the optional _tools module.
#include "binding.hpp"

namespace dotpose::python {

py::module_ tools_for(const char* wanted) {
    try {
        return py::module_::import("dotpose._tools");
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_ModuleNotFoundError)) throw;
    }
    throw py::import_error(
        std::string(wanted) +
        " needs the tools of dotpose, which this installation does not have; install the Debian "
        "package python3-dotpose or build from source: wrappers/python/README.md");
}

}  // namespace dotpose::python
