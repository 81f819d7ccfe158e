// Bindings for simulated frames with exactly known poses.
#include "dotpose/tools/simulate.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <fmt/core.h>

#include "binding.hpp"
#include "dotpose/files/code_names.hpp"
#include "image.hpp"

namespace dotpose::python {
namespace {

/// An imperfection that is described by a single number.
struct Effect {
    const char* name;
    double Imperfections::*member;
    const char* doc;
};

constexpr std::array kEffects = {
    Effect{"paper_level", &Imperfections::paper_level, "Grey level of bare paper, 0 to 255."},
    Effect{"ink_reflectance", &Imperfections::ink_reflectance,
           "Reflectance of ink, relative to paper."},
    Effect{"ink_variation", &Imperfections::ink_variation,
           "Standard deviation of a dot's reflectance."},
    Effect{"palest_ink", &Imperfections::palest_ink, "Contrast of the palest ink, 0 to 1."},
    Effect{"vignetting", &Imperfections::vignetting, "Loss of light in the corners, 0 to 1."},
    Effect{"fall", &Imperfections::fall,
           "Change of brightness from one side of the image to the other, 0 to 2."},
    Effect{"blur_sigma_px", &Imperfections::blur_sigma_px,
           "Standard deviation of the blur of the lens, in px."},
    Effect{"noise_sigma", &Imperfections::noise_sigma,
           "Standard deviation of the noise, in grey levels."},
    Effect{"fixed_pattern", &Imperfections::fixed_pattern,
           "Standard deviation of the offsets of the pixels, in grey levels."},
    Effect{"salt_and_pepper", &Imperfections::salt_and_pepper,
           "Fraction of the pixels that are black or white, 0 to 1."},
    Effect{"jitter_mm", &Imperfections::jitter_mm,
           "Standard deviation of the position of a printed dot, per axis, in mm."},
    Effect{"missing", &Imperfections::missing, "Fraction of the dots that are missing, 0 to 1."},
    Effect{"texture", &Imperfections::texture, "Standard deviation of the paper's reflectance."},
};

/// A shot and its rendered image.
struct SimulatedFrame {
    Shot shot;
    py::array_t<std::uint8_t> image;
};

/// Splits a coordinate, in spacings, into a cell and a fraction. Throws BadArgument if the
/// coordinate is outside the pattern.
void set_grid(double x, std::uint32_t& cell, double& fraction) {
    if (!(x >= 0 && x < kPositionsPerAxis)) throw BadArgument("the place is not on the pattern");
    cell = static_cast<std::uint32_t>(x);
    fraction = x - cell;
}

py::array_t<std::uint8_t> rendered(const Shot& shot) {
    GreyImage image;
    {
        const py::gil_scoped_release others_may_run;
        image = render(shot);
    }
    return array_of(std::move(image));
}

Preset preset_named(const std::string& wanted) {
    for (const Preset preset : kPresets)
        if (wanted == name(preset)) return preset;
    throw BadArgument("preset: '" + wanted + "' is none of clean, nominal, hard, mouse");
}

Setup new_setup(const std::string& preset, std::uint64_t seed, const std::string& code,
                double spacing_mm, const std::optional<std::array<int, 2>>& section,
                const CameraModel& camera) {
    Setup setup;
    setup.preset = preset_named(preset);
    setup.seed = seed;
    setup.pattern.code = code_named(code);
    setup.pattern.spacing_mm = spacing_mm;
    setup.pattern.displacement_mm = setup.pattern.dot_mm = spacing_mm / 6;
    if (section) {
        setup.random_section = false;
        for (const int part : *section)
            if (part < 0 || part >= kSections) throw BadArgument("section: must be 0 to 62");
        setup.pattern.section = {static_cast<std::uint8_t>((*section)[0]),
                                 static_cast<std::uint8_t>((*section)[1])};
    }
    setup.camera = camera;
    return setup;
}

std::vector<Shot> draw_shots(int frames, const std::string& preset, std::uint64_t seed,
                             const std::string& code, double spacing_mm,
                             const std::optional<std::array<int, 2>>& section, int width_px,
                             int height_px, double mm_per_px, double k_per_px2,
                             std::uint64_t first) {
    if (frames < 0) throw BadArgument("frames: must be at least 0");
    CameraModel camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.mm_per_px = mm_per_px;
    camera.k = k_per_px2;
    const Setup setup = new_setup(preset, seed, code, spacing_mm, section, camera);
    std::vector<Shot> shots;
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(frames); ++i)
        shots.push_back(draw_shot(setup, first + i));
    return shots;
}

void define_shot(py::module_& module) {
    py::class_<Shot> shot(module, "Shot",
                          "All inputs of a simulated frame. Change them as required, then render.");
    const auto spacing = [](const Shot& s) { return s.page.pattern.spacing_mm; };
    shot.def_property(
            "x_mm", [=](const Shot& s) { return x_grid(s.pose) * spacing(s); },
            [=](Shot& s, double mm) {
                set_grid(mm / spacing(s), s.pose.cell.x, s.pose.fraction_x);
            },
            "Pattern point under the image centre, to the right, in mm.")
        .def_property(
            "y_mm", [=](const Shot& s) { return y_grid(s.pose) * spacing(s); },
            [=](Shot& s, double mm) {
                set_grid(mm / spacing(s), s.pose.cell.y, s.pose.fraction_y);
            },
            "Pattern point under the image centre, DOWN the page, in mm.")
        .def_property(
            "theta_rad", [](const Shot& s) { return s.pose.theta_rad; },
            [](Shot& s, double rad) { s.pose.theta_rad = rad; },
            "Angle of the image x axis in the pattern, clockwise on the paper, in rad.")
        .def_property(
            "tilt_x_rad", [](const Shot& s) { return s.pose.tilt_x_rad; },
            [](Shot& s, double rad) { s.pose.tilt_x_rad = rad; },
            "Tilt of the paper about the image x axis, in rad.")
        .def_property(
            "tilt_y_rad", [](const Shot& s) { return s.pose.tilt_y_rad; },
            [](Shot& s, double rad) { s.pose.tilt_y_rad = rad; },
            "Tilt of the paper about the image y axis, in rad.")
        .def(
            "move",
            [](Shot& s, double x_grid, double y_grid) {
                s.pose.fraction_x += x_grid;
                s.pose.fraction_y += y_grid;
            },
            "x_grid"_a, "y_grid"_a, "Move the camera by a number of grid spacings.")
        .def_property_readonly(
            "section",
            [](const Shot& s) {
                return py::make_tuple(s.page.pattern.section.u, s.page.pattern.section.v);
            },
            "Section (u, v) of the printed pattern.")
        .def_property_readonly(
            "code", [](const Shot& s) { return name(s.page.pattern.code); },
            "Code that is printed.")
        .def_readwrite("seed", &Shot::seed, "Seed of noise, dirt and graphics.")
        .def("render", &rendered, "Return the image: uint8, height x width.")
        .def("__copy__", [](const Shot& s) { return Shot(s); });
    for (const Effect& effect : kEffects) {
        shot.def_property(
            effect.name,
            [member = effect.member](const Shot& s) { return s.imperfections.*member; },
            [member = effect.member](Shot& s, double value) { s.imperfections.*member = value; },
            effect.doc);
    }
}

}  // namespace

void define_simulate(py::module_& module) {
    define_shot(module);
    module.def("draw_shots", &draw_shots, "frames"_a, "preset"_a = "nominal", py::kw_only(),
               "seed"_a = 1, "code"_a = "anoto", "spacing_mm"_a = kDefaultSpacing_mm,
               "section"_a = py::none(), "width_px"_a = 188, "height_px"_a = 120,
               "mm_per_px"_a = 0.046, "k_per_px2"_a = 0.0, "first"_a = 0,
               "Return the inputs of simulated frames, a list of Shot, as simulate draws them.");
    py::class_<SimulatedFrame>(module, "SimulatedFrame", "A simulated frame with its true pose.")
        .def_readonly("image", &SimulatedFrame::image, "The image: uint8, height x width.")
        .def_readonly("shot", &SimulatedFrame::shot, "The true pose, and all other inputs.");
    module.def(
        "simulate",
        [](int frames, const std::string& preset, std::uint64_t seed, const std::string& code,
           double spacing_mm, const std::optional<std::array<int, 2>>& section, int width_px,
           int height_px, double mm_per_px, double k_per_px2, std::uint64_t first) {
            std::vector<SimulatedFrame> result;
            for (const Shot& shot : draw_shots(frames, preset, seed, code, spacing_mm, section,
                                               width_px, height_px, mm_per_px, k_per_px2, first))
                result.push_back({shot, rendered(shot)});
            return result;
        },
        "frames"_a, "preset"_a = "nominal", py::kw_only(), "seed"_a = 1, "code"_a = "anoto",
        "spacing_mm"_a = kDefaultSpacing_mm, "section"_a = py::none(), "width_px"_a = 188,
        "height_px"_a = 120, "mm_per_px"_a = 0.046, "k_per_px2"_a = 0.0, "first"_a = 0,
        "Return simulated frames, a list of SimulatedFrame, the same on every machine.\n\n"
        "preset: \"clean\", \"nominal\" or \"hard\". section: (u, v); default: random for each "
        "frame.\n"
        "mm_per_px: size of a pixel on the paper, in mm. k_per_px2: distortion of the lens, in "
        "1/px^2.\n"
        "first: number of the first frame, to continue an earlier run.");
}

}  // namespace dotpose::python
