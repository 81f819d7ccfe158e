// Bindings for the locator options, with the same names and units as in C++.
#include <array>

#include "binding.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/option_names.hpp"
#include "dotpose/locator_options.hpp"

namespace dotpose::python {
namespace {

template <typename Value, std::size_t size>
Value named(const char* what, const std::string& wanted, const std::array<Value, size>& values) {
    std::string known;
    for (const Value value : values) {
        if (wanted == name(value)) return value;
        known += std::string(known.empty() ? "" : ", ") + name(value);
    }
    throw BadArgument(std::string(what) + ": '" + wanted + "' is none of " + known);
}

/// Returns options with the members named in `given` set, and all other members at their defaults.
/// Throws TypeError for an unknown name.
LocatorOptions options_of(const py::kwargs& given) {
    py::object self = py::cast(LocatorOptions{});
    for (const auto& [key, value] : given) {
        if (!py::hasattr(self, key)) {
            throw py::type_error("Options has no '" + std::string(py::str(key)) + "'");
        }
        self.attr(py::reinterpret_borrow<py::object>(key)) = value;
    }
    return self.cast<LocatorOptions>();
}

}  // namespace

void define_options(py::module_& module) {
    using Given = LocatorOptions;
    py::class_<Given>(
        module, "Options",
        "Options of a locator. The defaults suit any camera. Ranges are in [brackets];\n"
        "a locator raises BadArgument for a value that is out of range.")
        .def(py::init(&options_of), "Make options from keyword arguments: Options(min_dots=60).")
        .def_property(
            "effort", [](const Given& o) { return name(o.effort); },
            [](Given& o, const std::string& value) { o.effort = named("effort", value, kEfforts); },
            "Number of attempts per frame: \"twice\", \"once\", or \"device\" as on a "
            "microcontroller.")
        .def_property(
            "decoder", [](const Given& o) { return name(o.decoder); },
            [](Given& o, const std::string& value) {
                o.decoder = named("decoder", value, kDecoders);
            },
            "Dots from which the position is read: \"all\", or \"window\" as in the paper.")
        .def_readwrite(
            "min_contrast", &Given::min_contrast,
            "Minimum contrast between paper and dots, in grey levels. Frames with less contrast "
            "have the status no_contrast. Raise the minimum for noisy cameras. [0 to 255]")
        .def_readwrite("min_dots", &Given::min_dots,
                       "Minimum number of dots for the search for a grid. [0 to 2^20]")
        .def_readwrite("max_p_wrong", &Given::max_p_wrong,
                       "Maximum probability of a wrong position. Positions above this limit are "
                       "refused. Rounded down to a power of two. [1e-300 to 1]")
        .def_readwrite("max_bit_errors", &Given::max_bit_errors,
                       "Maximum ratio of wrong bits on either axis. [0 to 1]")
        .def_readwrite("bits_per_error", &Given::bits_per_error,
                       "Minimum number of bits per misread bit, on average over frames of the "
                       "same print and camera. A known number makes smaller views certain. 0 if "
                       "unknown. -1 measures the number over all frames so far. [-1 to 65536]")
        .def_readwrite("lens_k_per_px2", &Given::lens_k_per_px2,
                       "Radial distortion k in 1/px^2 (eq. 2 of the paper); negative for barrel "
                       "distortion. Set by a "
                       "camera file.")
        .def_property(
            "lens_centre_offset_px",
            [](const Given& o) { return py::make_tuple(o.lens_centre_dx_px, o.lens_centre_dy_px); },
            [](Given& o, const std::array<double, 2>& offset_px) {
                o.lens_centre_dx_px = offset_px[0];
                o.lens_centre_dy_px = offset_px[1];
            },
            "Centre of the distortion, from the image centre, in px.");
}

DeviceOptions checked(const LocatorOptions& options) {
    if (const char* bad = bad_option(options)) {
        throw BadArgument(std::string("Options: ") + bad + " is out of range");
    }
    return options;
}

}  // namespace dotpose::python
