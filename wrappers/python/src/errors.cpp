// Translates exceptions thrown by the tools into Python exceptions.
#include <exception>

#include "binding.hpp"
#include "dotpose/files/code_names.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::python {
namespace {

/// Translates a C++ exception into the Python exception with the same name, and raises it.
void translate(std::exception_ptr error) {
    const auto raise = [](const char* name, const std::exception& what) {
        const py::object type = py::module_::import("dotpose._dotpose").attr(name);
        PyErr_SetString(type.ptr(), what.what());
    };
    try {
        std::rethrow_exception(error);
    } catch (const ImageTooLarge& large) {
        const py::object type = py::module_::import("dotpose._dotpose").attr("ImageTooLarge");
        py::object raised = type(large.what());
        raised.attr("width_px") = large.width_px;
        raised.attr("height_px") = large.height_px;
        PyErr_SetObject(type.ptr(), raised.ptr());
    } catch (const BadArgument& bad) {
        raise("BadArgument", bad);
    } catch (const Error& other) {
        raise("Error", other);
    }
}

py::object new_exception(py::module_& module, const char* name, const py::tuple& bases,
                         const char* doc) {
    const std::string full_name = std::string("dotpose.") + name;
    auto type = py::reinterpret_steal<py::object>(
        PyErr_NewExceptionWithDoc(full_name.c_str(), doc, bases.ptr(), nullptr));
    if (!type) throw py::error_already_set();
    module.attr(name) = type;
    return type;
}

}  // namespace

void define_errors(py::module_& module) {
    const py::object runtime_error = py::reinterpret_borrow<py::object>(PyExc_RuntimeError);
    const py::object value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
    const py::object error =
        new_exception(module, "Error", py::make_tuple(runtime_error),
                      "An operation failed; the text names the file or value concerned.\n\n"
                      "A frame without a fix is not an error: see Fix.ok.");
    new_exception(module, "BadArgument", py::make_tuple(error, value_error),
                  "An argument is invalid; the text names the value.");
    const py::object large =
        new_exception(module, "ImageTooLarge", py::make_tuple(error),
                      "An image file has more pixels than the limit: width_px x height_px.");
    large.attr("width_px") = 0;
    large.attr("height_px") = 0;
    py::register_exception_translator(translate);
}

CodeVariant code_named(const std::string& name) {
    if (const auto code = code_by_name(name)) return *code;
    throw BadArgument("code: '" + name + "' is none of anoto, libdots, microdots");
}

std::optional<CodeVariant> code_or_auto(const std::string& name) {
    if (name == "auto") return std::nullopt;
    if (const auto code = code_by_name(name)) return code;
    throw BadArgument("code: '" + name + "' is none of auto, anoto, libdots, microdots");
}

}  // namespace dotpose::python
