/// Progress of long work, asked for now and then while the interpreter's lock is released: Ctrl-C
/// ends the work.
#pragma once

#include "binding.hpp"

namespace dotpose::python {

/// Whether a signal has come that raises an exception in Python. The exception is then set.
inline bool was_interrupted() {
    const py::gil_scoped_acquire lock;
    return PyErr_CheckSignals() != 0;
}

/// Runs the work without the interpreter's lock. An exception of Python, such as KeyboardInterrupt,
/// that was set meanwhile counts instead of the one that the work then throws.
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
