// Options: thresholds and limits of locating, flat, with the names and units of C++.
#include "dotpose/options.hpp"

#include <array>

#include "binding.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/option_names.hpp"
#include "rounded.hpp"

namespace dotpose::python {
namespace {

/// A number of Options that Python sees under a name.
struct Number {
    const char* name;
    int& (*at)(Options&);
    const char* doc;
};

constexpr std::array kNumbers = {
    Number{"threshold_low_q8", [](Options& o) -> int& { return o.threshold.low_q8; },
           "Share of the local contrast, in 1/256, by which a pixel of a blob is darker than the "
           "paper. [1 to 256]"},
    Number{"threshold_high_q8", [](Options& o) -> int& { return o.threshold.high_q8; },
           "Share of the local contrast, in 1/256, by which some pixel of a blob must be darker. "
           "[1 to 256]"},
    Number{"min_contrast", [](Options& o) -> int& { return o.threshold.min_contrast; },
           "Grey levels of contrast below which an area is blank. Raise it for noisy cameras. "
           "[1 to 255]"},
    Number{"min_area_px", [](Options& o) -> int& { return o.blobs.min_area_px; },
           "Fewest pixels of a dot. [0 to 2^20]"},
    Number{
        "min_mass_q8", [](Options& o) -> int& { return o.blobs.min_mass_q8; },
        "Blobs less dark than this share, in 1/256, of the upper quartile are noise. [0 to 256]"},
    Number{"max_area_ratio", [](Options& o) -> int& { return o.blobs.max_area_ratio; },
           "Blobs larger than this multiple of the upper quartile are graphics. [1 to 1024]"},
    Number{"min_dots", [](Options& o) -> int& { return o.lattice.min_dots; },
           "Fewest dots from which a grid is searched. [0 to 2^20]"},
    Number{"max_offset_q16", [](Options& o) -> int& { return o.lattice.max_offset_q16; },
           "Greatest distance of a dot from its intersection, per axis, in 2^-16 spacing. "
           "[0 to 32768]"},
    Number{"max_p_wrong_log2", [](Options& o) -> int& { return o.integrity.max_p_wrong_log2; },
           "Bound, as log2, of the probability of being wrong above which a position is refused. "
           "[-2^20 to 0]"},
    Number{"max_bit_error_q8", [](Options& o) -> int& { return o.integrity.max_bit_error_q8; },
           "Greatest share, in 1/256, of wrong bits on either axis. [0 to 256]"},
    Number{"most_dots", [](Options& o) -> int& { return o.most_dots; },
           "Greatest number of dots that the pose is fitted to: accuracy grows with its root, "
           "time with the number. [any; limited to what the memory holds]"},
};

template <typename Value, std::size_t size>
Value named(const char* what, const std::string& wanted, const std::array<Value, size>& values) {
    std::string known;
    for (const Value value : values) {
        if (wanted == name(value)) return value;
        known += std::string(known.empty() ? "" : ", ") + name(value);
    }
    throw BadArgument(std::string(what) + ": '" + wanted + "' is none of " + known);
}

/// Sets the members that are given by name; a name that there is none of is a TypeError.
Options options_of(const py::kwargs& given) {
    py::object self = py::cast(Options{});
    for (const auto& [key, value] : given) {
        if (!py::hasattr(self, key)) {
            throw py::type_error("Options has no '" + std::string(py::str(key)) + "'");
        }
        self.attr(py::reinterpret_borrow<py::object>(key)) = value;
    }
    return self.cast<Options>();
}

void define_lens(py::class_<Options>& options) {
    constexpr double kQ40 = 1099511627776.0;
    options
        .def_property(
            "lens_k_per_px2", [](const Options& o) { return o.lens.k_q40 / kQ40; },
            [](Options& o, double k) { o.lens.k_q40 = rounded(k * kQ40); },
            "Radial distortion k in 1/px^2 (eq. 2 of the paper); below 0 for barrel. A camera file "
            "sets it.")
        .def_property(
            "lens_centre_offset_px",
            [](const Options& o) {
                return py::make_tuple(o.lens.centre_dx_q8 / 256.0, o.lens.centre_dy_q8 / 256.0);
            },
            [](Options& o, const std::array<double, 2>& offset_px) {
                o.lens.centre_dx_q8 = rounded(offset_px[0] * 256);
                o.lens.centre_dy_q8 = rounded(offset_px[1] * 256);
            },
            "Centre of the distortion, from the image centre, in px.");
}

}  // namespace

void define_options(py::module_& module) {
    py::class_<Options> options(
        module, "Options",
        "Thresholds and limits of locating; the defaults suit any camera. Ranges stand in\n"
        "[brackets]; a value outside gives every frame the status bad_argument.");
    options
        .def(py::init(&options_of),
             "Make options; members are given by their names: Options(min_dots=60).")
        .def_property(
            "effort", [](const Options& o) { return name(o.effort); },
            [](Options& o, const std::string& value) {
                o.effort = named("effort", value, kEfforts);
            },
            "Attempts for a frame: \"twice\", \"once\", or \"device\" as on a microcontroller.")
        .def_property(
            "decoder", [](const Options& o) { return name(o.decoder); },
            [](Options& o, const std::string& value) {
                o.decoder = named("decoder", value, kDecoders);
            },
            "Dots that the position is read from: \"all\", or \"window\" as in the paper.");
    for (const Number& number : kNumbers) {
        options.def_property(
            number.name, [at = number.at](Options& o) { return at(o); },
            [at = number.at](Options& o, int value) { at(o) = value; }, number.doc);
    }
    define_lens(options);
}

}  // namespace dotpose::python
