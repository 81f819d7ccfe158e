/// Runs long operations with the GIL released. The operations check for Ctrl-C regularly, and stop
/// when it is pressed.
#pragma once

#include "binding.hpp"

namespace dotpose::python {

/// Returns true if a signal handler has raised a Python exception. The exception remains set.
inline bool was_interrupted() {
    const py::gil_scoped_acquire lock;
    return PyErr_CheckSignals() != 0;
}

/// Runs `work` with the GIL released. If `work` throws and a Python exception such as
/// KeyboardInterrupt was set in the meantime, raises the Python exception instead.
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
