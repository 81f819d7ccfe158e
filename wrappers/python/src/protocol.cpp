// Bindings for the simulated experiment (paper, section IV).
#include "dotpose/tools/protocol.hpp"

#include "binding.hpp"
#include "progress.hpp"

namespace dotpose::python {
namespace {

template <typename Get>
py::tuple bias_and_sigma(const Station& station, Get get) {
    const Spread& spread = get(station);
    return py::make_tuple(spread.bias, spread.sigma);
}

}  // namespace

void define_protocol(py::module_& module) {
    py::class_<Station>(module, "Station",
                        "Results at one position or angle of the paper's experiment; errors as "
                        "(bias, sigma).")
        .def_property_readonly(
            "place_mm", [](const Station& s) { return py::make_tuple(s.place_mm.x, s.place_mm.y); },
            "Position (x, y) relative to the middle of the area, y DOWN, in mm.")
        .def_readonly("theta_deg", &Station::theta_deg, "Angle of the device, in degrees.")
        .def_property_readonly(
            "x_mm",
            [](const Station& s) {
                return bias_and_sigma(s, [](const Station& t) -> const Spread& { return t.x_mm; });
            },
            "Error of x, in mm.")
        .def_property_readonly(
            "y_mm",
            [](const Station& s) {
                return bias_and_sigma(s, [](const Station& t) -> const Spread& { return t.y_mm; });
            },
            "Error of y, in mm.")
        .def_property_readonly(
            "theta_error_deg",
            [](const Station& s) {
                return bias_and_sigma(s, [](const Station& t) -> const Spread& { return t.theta; });
            },
            "Error of theta, in degrees.")
        .def_readonly("samples", &Station::samples, "Frames.")
        .def_readonly("located", &Station::located, "Number of correct fixes.")
        .def_readonly("wrong", &Station::wrong, "Number of wrong fixes.");
    py::class_<ProtocolResult>(module, "ProtocolResult", "The experiment on one page.")
        .def_readonly("positions", &ProtocolResult::positions,
                      "Stations at 11 x 11 positions on an area of 200 x 200 mm.")
        .def_readonly("angles", &ProtocolResult::angles,
                      "Stations at 36 angles, in the middle of the area.");
    py::class_<Protocol>(module, "Protocol", "The experiment on a perfect and on a printed page.")
        .def_readonly("perfect", &Protocol::perfect,
                      "Results on a page on which every dot is at its nominal position.")
        .def_readonly("printed", &Protocol::printed,
                      "Results on a page with the errors of a printer.");
    module.def(
        "run_protocol",
        [](int samples, std::uint64_t seed, int threads) {
            ProtocolOptions options;
            options.samples = samples;
            options.setup.seed = seed;
            options.threads = threads;
            options.progress = [](int, int) { return !was_interrupted(); };
            return without_lock([&] { return run_protocol(options); });
        },
        "samples"_a = 20, py::kw_only(), "seed"_a = 1, "threads"_a = 0,
        "Simulate the paper's experiment with a number of samples at each position and angle. "
        "Return a Protocol. threads: number of threads; 0 for one per core.");
}

}  // namespace dotpose::python
