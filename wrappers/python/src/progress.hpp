/// Progress of long operations. Checks regularly for Ctrl-C while the GIL is released, and ends the
/// operation.
#pragma once

#include "binding.hpp"

namespace dotpose::python {

/// Returns true if a signal has raised an exception in Python, which is then set.
inline bool was_interrupted() {
    const py::gil_scoped_acquire lock;
    return PyErr_CheckSignals() != 0;
}

/// Runs the work with the GIL released. If a Python exception such as KeyboardInterrupt was set
/// meanwhile, it is raised instead of the exception that the work throws.
template <typename Work>
auto without_lock(const Work& work) {
    try {
        const py::gil_scoped_release others_may_run;
        return work();
    } catch (...) {
        if (PyErr_Occurred() != nullptr) throw py::error_already_set();
        throw;
    }
}

}  // namespace dotpose::python
