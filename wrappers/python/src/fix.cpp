// Bindings for Fix, Prediction and Picture.
#include "fix.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/files/error.hpp"
#include "picture.hpp"
#include "rounded.hpp"

namespace dotpose::python {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kBam_per_rad = 2147483648.0 / std::numbers::pi;

/// Returns a getter for a numeric field of a fix. The getter returns NaN if the status is not ok.
template <typename Get>
auto if_ok(Get get) {
    return [get](const PyFix& self) { return self.is_ok() ? double{get(self.fix)} : kNaN; };
}

py::object pair_if_ok(const PyFix& self, std::uint32_t first, std::uint32_t second) {
    if (!self.is_ok()) return py::none();
    return py::make_tuple(first, second);
}

py::array_t<double> dots(PyFix& self) {
    const std::vector<PixelPoint> pixels = self.seen_stages().dots_px();
    py::array_t<double> array({static_cast<py::ssize_t>(pixels.size()), py::ssize_t{2}});
    auto at = array.mutable_unchecked<2>();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        at(static_cast<py::ssize_t>(i), 0) = pixels[i].u;
        at(static_cast<py::ssize_t>(i), 1) = pixels[i].v;
    }
    return array;
}

py::object draw(const py::object& self, const py::object& path, const std::string& title) {
    return tools_for("Fix.draw").attr("_draw")(self, path, title);
}

py::object other(const PyFix& self) {
    if (!self.other) return py::none();
    return py::make_tuple(name(self.other->code),
                          py::make_tuple(self.other->cell.x, self.other->cell.y),
                          py::make_tuple(self.other->section.u, self.other->section.v));
}

std::string message_of(const PyFix& self) {
    return self.fault.empty() ? message(self.fix.status) : self.fault;
}

std::string text_of_fix(const PyFix& self) {
    const Fix& fix = self.fix;
    if (!self.is_ok()) return fmt::format("<Fix {}: {}>", name(fix.status), message_of(self));
    return fmt::format("<Fix ok: x {:.4f} mm, y {:.4f} mm, theta {:.5f} rad, p_wrong {:.2g}>",
                       fix.x_mm(), fix.y_mm(), fix.theta_rad(), fix.p_wrong());
}

/// Appends numbers to a list, in the format of the golden lines (wrappers/golden).
class Bits {
  public:
    template <typename Value>
    void put(const Value& value) {
        if constexpr (std::is_enum_v<Value>)
            list_.append(static_cast<int>(value));
        else
            list_.append(value);
    }
    void put(const Place& place) {
        for (const std::uint32_t value : {place.cell.x, place.cell.y})
            put(value);
        for (const int value : {int{place.section.u}, int{place.section.v}})
            put(value);
    }
    void put(const PlaneFromImage& plane) {
        for (const FixedVec vec : {plane.centre_q8, plane.at_centre_q16, plane.du_q24, plane.dv_q24,
                                   plane.perspective_q30}) {
            put(vec.x);
            put(vec.y);
        }
        put(plane.lens_q40);
    }
    /// Appends the in-memory bytes of a number, because tests compare all bits.
    template <typename Value>
    void put_bits(Value value) {
        list_.append(py::bytes(reinterpret_cast<const char*>(&value), sizeof value));
    }
    void put(float value) { put_bits(value); }
    void put(double value) { put_bits(value); }
    void put_covariance(const Fix& fix, double unit) {
        const double units[] = {unit, unit, 1};
        for (int i = 0; i < 9; ++i) {
            const auto value = static_cast<double>(fix.covariance[i / 3][i % 3]);
            put(static_cast<float>(units[i / 3] * units[i % 3] * value));
        }
    }
    const py::list& list() const { return list_; }

  private:
    py::list list_;
};

/// Returns the numbers in the golden line for a fix (wrappers/golden). Floating-point numbers are
/// returned as bytes, so tests can compare them bit by bit.
py::list bits(const PyFix& self) {
    const Fix& fix = self.fix;
    Bits all;
    all.put(fix.status);
    all.put(fix.dots_seen);
    if (!self.is_ok()) return all.list();
    const double mm = fix.spacing_mm();
    constexpr double spacings = 1;
#define FIX_NUMBER(type, name, member, doc) all.put(fix.member);
#define FIX_EVIDENCE(type, name, is_known, doc) all.put(fix.name);
#define FIX_VALUE(type, name, value, none, doc) all.put(fix.value);
#define FIX_MATRIX(unit, name, doc) all.put_covariance(fix, unit);
#include "dotpose/fix_fields.def"
    return all.list();
}

/// Returns a field of the evidence as a Python object. An enumeration becomes its name. If
/// `is_known` is false, integers become 0 and floating-point numbers become NaN.
template <typename Value>
py::object evidence(bool is_known, Value value) {
    if constexpr (std::is_enum_v<Value>)
        return py::str(name(value));
    else if constexpr (std::is_floating_point_v<Value>)
        return py::float_(is_known ? double{value} : kNaN);
    else
        return py::int_(is_known ? value : 0);
}

void define_pose(py::class_<PyFix>& fix) {
    fix.def_property_readonly("ok", &PyFix::is_ok,
                              "True if there is a pose. Otherwise status and message give the "
                              "reason, and the numbers of the pose are nan or None.")
        .def("__bool__", &PyFix::is_ok, "The same as ok.")
        .def_property_readonly(
            "status", [](const PyFix& self) { return name(self.fix.status); },
            "Identifier of the result: \"ok\", \"too_few_dots\", ...")
        .def_property_readonly("message", &message_of,
                               "The status in one sentence, without a full stop.")
        .def_property_readonly("x_mm", if_ok([](const Fix& f) { return f.x_mm(); }),
                               "Pattern point under the reference point, to the right, in mm.")
        .def_property_readonly("y_mm", if_ok([](const Fix& f) { return f.y_mm(); }),
                               "Pattern point under the reference point, DOWN the page, in mm.")
        .def_property_readonly(
            "theta_rad", if_ok([](const Fix& f) { return f.theta_rad(); }),
            "Angle of the image x axis in the pattern, clockwise as seen on the paper, in rad, "
            "in [-pi, pi).")
        .def_property_readonly(
            "covariance",
            [](const PyFix& self) {
                return covariance_array(self.fix.covariance, self.fix.spacing_mm(),
                                        self.is_ok() && self.fix.has_covariance());
            },
            "Covariance of (x_mm, y_mm, theta_rad): 3 x 3, in mm^2, mm rad and rad^2.")
        .def_property_readonly(
            "p_wrong", [](const PyFix& self) { return self.is_ok() ? self.fix.p_wrong() : 1.0; },
            "Upper bound of the probability that the position is wrong; 1 without a fix.")
        .def_property_readonly(
            "section",
            [](const PyFix& self) {
                return pair_if_ok(self, self.fix.section.u, self.fix.section.v);
            },
            "Section (u, v) in which the position was read, each 0 to 62; None without a fix.")
        .def_property_readonly(
            "cell",
            [](const PyFix& self) { return pair_if_ok(self, self.fix.cell.x, self.fix.cell.y); },
            "Intersection (x, y) of the grid to the upper left of the reference point; None "
            "without a fix.")
        .def_property_readonly("x_grid", if_ok([](const Fix& f) { return f.x_grid(); }),
                               "The same as x_mm, in spacings of the grid.")
        .def_property_readonly("y_grid", if_ok([](const Fix& f) { return f.y_grid(); }),
                               "The same as y_mm, in spacings of the grid.");
}

/// Defines a property for each FIX_EVIDENCE field.
void define_fields(py::class_<PyFix>& seen_fix) {
#define FIX_EVIDENCE(type, name, is_known, doc)         \
    seen_fix.def_property_readonly(                     \
        #name,                                          \
        [](const PyFix& self) {                         \
            [[maybe_unused]] const Fix& fix = self.fix; \
            return evidence(is_known, self.fix.name);   \
        },                                              \
        doc ".");
#include "dotpose/fix_fields.def"
}

void define_evidence(py::class_<PyFix>& fix) {
    fix.def_property_readonly(
           "code", [](const PyFix& self) { return name(self.code); },
           "Code in which the position was read: \"anoto\", \"libdots\" or \"microdots\".")
        .def_property_readonly("other", &other,
                               "A place in another code that also explains the frame, as (code, "
                               "cell, section), or None.")
        .def_property_readonly("spacing_mm", if_ok([](const Fix& f) { return f.spacing_mm(); }),
                               "Spacing of the printed grid, in mm; nan if unknown.")
        .def_property_readonly("spacing_px", if_ok([](const Fix& f) { return f.spacing_px(); }),
                               "Spacing of the grid in the image, in px.")
        .def_property_readonly("_bits", &bits);
}

void define_prediction(py::module_& module) {
    py::class_<SeenPrediction>(module, "Prediction",
                               "The expected position of the pattern in the next frame. With a "
                               "prediction, locate is faster and equally certain.")
        .def_static("like", &SeenPrediction::like, "fix"_a,
                    "Return the prediction that the next frame has the same pose as a fix, which "
                    "must be ok.")
        .def(
            "moved",
            [](const SeenPrediction& self, double x_mm, double y_mm, double turn_rad) {
                const auto q16 = [&](double mm) { return rounded(mm / self.spacing_mm * 65536); };
                const std::int32_t turn_bam =
                    rounded(std::remainder(turn_rad, 2 * std::numbers::pi) * kBam_per_rad);
                SeenPrediction result = self;
                result.prediction = dotpose::moved(self.prediction, self.code,
                                                   {q16(x_mm), q16(y_mm)}, turn_bam, self.pivot_q8);
                return result;
            },
            "x_mm"_a, "y_mm"_a, "turn_rad"_a = 0.0,
            "Return the prediction for a camera that has moved in the pattern, in mm, and turned "
            "about its reference point, in rad.")
        .def_property(
            "sigma_mm",
            [](const SeenPrediction& self) {
                return self.prediction.sigma_q16 / 65536.0 * self.spacing_mm;
            },
            [](SeenPrediction& self, double mm) {
                self.prediction.sigma_q16 = rounded(mm / self.spacing_mm * 65536);
            },
            "Standard deviation of the expected x and y, in mm.")
        .def_property(
            "sigma_theta_rad",
            [](const SeenPrediction& self) {
                return self.prediction.sigma_theta_bam / kBam_per_rad;
            },
            [](SeenPrediction& self, double rad) {
                self.prediction.sigma_theta_bam = rounded(rad * kBam_per_rad);
            },
            "Standard deviation of the expected angle, in rad.");
}

}  // namespace

const Stages& PyFix::seen_stages() {
    if (!stages) {
        if (!source) throw Error("this fix has no frame");
        stages = source->stages_of(number);
    }
    return *stages;
}

PyFix seen_fix(const CodeReading& reading) {
    PyFix seen;
    seen.fix = reading.fix;
    seen.code = reading.code;
    if (reading.has_other)
        seen.other = {reading.other_code, reading.other_cell, reading.other_section};
    return seen;
}

SeenPrediction SeenPrediction::like(const PyFix& seen) {
    if (!seen.is_ok()) throw BadArgument("a prediction needs a fix that is ok");
    const FixedVec centre_q8 = seen.fix.pattern_from_image.centre_q8;
    return {Prediction::like(seen.fix),
            seen.code,
            seen.fix.spacing_mm(),
            {centre_q8.x + seen.reference_q8.x, centre_q8.y + seen.reference_q8.y}};
}

py::array_t<double> covariance_array(const float (&covariance)[3][3], double spacing_mm,
                                     bool is_known) {
    py::array_t<double> array({3, 3});
    auto at = array.mutable_unchecked<2>();
    const double units[3] = {spacing_mm, spacing_mm, 1};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            at(i, j) = is_known ? double{covariance[i][j]} * units[i] * units[j] : kNaN;
    return array;
}

void define_fix(py::module_& module) {
    define_picture(module);
    py::class_<PyFix> fix(
        module, "Fix",
        "The pose computed from one frame, with its evidence. True if there is a pose.\n\n"
        "In the pattern frame, x points to the right and y DOWN on the page as it is read. The\n"
        "pose is the pattern point at the reference point (by default the image centre).");
    define_pose(fix);
    define_evidence(fix);
    define_fields(fix);
    fix.def_property_readonly(
           "dots", &dots,
           "Pixels (u, v) where dots were found, n x 2; the centre of the first pixel is (0, 0). "
           "Only available for the newest fix of a locator, unless it keeps stages.")
        .def("draw", &draw, "path"_a = py::none(), "title"_a = "",
             "Return a picture (SVG) of the frame with dots, grid, bits and pose, or of the stages "
             "that it reached. With path, also write a file. Only available for the newest fix of "
             "a locator, "
             "unless it keeps stages.")
        .def("__repr__", &text_of_fix);
    define_prediction(module);
}

}  // namespace dotpose::python
