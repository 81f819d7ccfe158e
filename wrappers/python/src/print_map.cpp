// Bindings for print maps: reading, writing and creating them.
#include "dotpose/files/print_map.hpp"

#include <fmt/core.h>

#include "dotpose/files/camera.hpp"
#include "dotpose/files/write_file.hpp"
#include "dotpose/tools/print_mapping.hpp"
#include "frames.hpp"
#include "progress.hpp"
#include "sheets.hpp"

namespace dotpose::python {
namespace {

std::vector<std::string> page_names(const PrintMap& map) {
    std::vector<std::string> names;
    for (const MapPage& page : map.pages)
        names.push_back(page.name);
    return names;
}

PrintMapResult make_print_map(const py::iterable& images, const std::vector<SheetEntry>& sheets,
                              const std::optional<Camera>& camera,
                              const std::optional<PrintMap>& earlier) {
    PrintMapping mapping(
        {.sheets = sheets, .camera = camera, .earlier = earlier.value_or(PrintMap{})});
    // Reads the images one by one, to keep only one image in memory.
    for (const py::handle& image : images) {
        const Frame frame = frame_of(image);
        without_lock([&] { return mapping.add(pixels_of(frame).view()); });
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return without_lock([&] { return mapping.solve([](double) { return !was_interrupted(); }); });
}

}  // namespace

void define_print_map(py::module_& module) {
    py::class_<PrintMap>(module, "PrintMap",
                         "The measured offsets of the dots of printed pages: a map file.")
        .def_static(
            "read",
            [](const std::filesystem::path& path) {
                return without_lock([&] { return read_print_map(path); });
            },
            "path"_a, "Return the map of a map file.")
        .def(
            "write",
            [](const PrintMap& self, const std::filesystem::path& path) {
                write_file(path, print_map_bytes(self));
            },
            "path"_a, "Write a map file atomically.")
        .def_property_readonly("pages", &page_names, "Names of the sheets of the map.")
        .def("__repr__", [](const PrintMap& self) {
            return fmt::format("<PrintMap of {} pages>", self.pages.size());
        });
    py::class_<MappedPage>(module, "MappedPage", "Statistics of the map of one page.")
        .def_readonly("name", &MappedPage::name, "Name of the sheet.")
        .def_readonly("frames", &MappedPage::frames, "Number of frames used.")
        .def_readonly("dots", &MappedPage::dots, "Number of dots of the page.")
        .def_readonly("seen", &MappedPage::seen, "Number of dots that were seen.")
        .def_readonly("noise_mm", &MappedPage::noise_mm,
                      "Standard deviation of a measured dot, per axis, in mm.")
        .def_readonly("jitter_mm", &MappedPage::jitter_mm,
                      "Standard deviation of the print jitter, per axis, in mm.")
        .def_readonly("slow_mm", &MappedPage::slow_mm,
                      "Rms of the slow distortion of the page, per axis, in mm.")
        .def_readonly("error_mm", &MappedPage::error_mm,
                      "Standard deviation of the error of the map in one view, per axis, in mm; "
                      "0 if not known.")
        .def_readonly("is_rigid", &MappedPage::is_rigid,
                      "True if height and tilt of the camera were constant.");
    py::class_<PrintMapResult>(module, "PrintMapResult", "A new or updated map of the print.")
        .def_readonly("map", &PrintMapResult::map, "The PrintMap.")
        .def_readonly("pages", &PrintMapResult::pages, "MappedPage of each page that was seen.")
        .def_readonly("frames", &PrintMapResult::frames, "Number of frames given.");
    module.def("make_print_map", &make_print_map, "images"_a, "sheets"_a, "camera"_a = py::none(),
               "earlier"_a = py::none(),
               "Return the map of printed pages, from at least 10 images of a page: arrays or "
               "paths. Images may come from a generator; only one is kept in memory.\n\n"
               "earlier: a PrintMap of the same pages that the images update.");
}

}  // namespace dotpose::python
