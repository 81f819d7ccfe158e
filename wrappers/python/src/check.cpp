// check_print: what a scan or photo of a printed sheet shows about printer and paper.
#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/tools/check_print.hpp"
#include "dotpose/tools/draw.hpp"
#include "frames.hpp"
#include "progress.hpp"
#include "sheets.hpp"

namespace dotpose::python {
namespace {

/// A check with its scan, which its picture shows.
struct SeenCheck {
    PrintCheck check;
    GreyImage scan;
};

void define_scale(py::module_& module) {
    py::class_<PrintScale>(module, "PrintScale",
                           "Scale and angles of a print on a flatbed scan; the scanner's own are "
                           "part of them.")
        .def_readonly("scale_x", &PrintScale::scale_x, "Printed over nominal length along x.")
        .def_readonly("scale_y", &PrintScale::scale_y, "Printed over nominal length along y.")
        .def_readonly("rotation_rad", &PrintScale::rotation_rad,
                      "Direction of the pattern's x axis in the scan, in rad.")
        .def_readonly("skew_rad", &PrintScale::skew_rad,
                      "Excess over 90 degrees of the angle between the axes, in rad.");
    py::class_<Finding>(module, "Finding", "One fault or remark about a print.")
        .def_property_readonly(
            "kind", [](const Finding& f) { return name(f.kind); },
            "Identifier, such as \"uneven_scale\"; \"good\" if there is no fault.")
        .def_readonly("is_fault", &Finding::is_fault, "Whether it should be corrected.")
        .def_readonly("field", &Finding::field, "Index of the field concerned; None: the scan.")
        .def_readonly("text", &Finding::text, "What is wrong, the likely cause, the remedy.")
        .def("__repr__", [](const Finding& f) {
            return fmt::format("<Finding {}: {}>", name(f.kind), f.text);
        });
}

void define_field(py::module_& module) {
    py::class_<PrintField>(module, "PrintField", "One contiguous region of the code on a scan.")
        .def_property_readonly(
            "code", [](const PrintField& f) { return name(f.pattern.code); }, "Its code.")
        .def_property_readonly(
            "section",
            [](const PrintField& f) {
                return py::make_tuple(f.pattern.section.u, f.pattern.section.v);
            },
            "Section (u, v) that was read.")
        .def_property_readonly(
            "origin", [](const PrintField& f) { return py::make_tuple(f.origin.x, f.origin.y); },
            "First cell (x, y) of the region.")
        .def_readonly("columns", &PrintField::columns, "Columns of the region.")
        .def_readonly("rows", &PrintField::rows, "Rows of the region.")
        .def_readonly("is_patch", &PrintField::is_patch, "Whether it is a patch of a test page.")
        .def_readonly("sheet", &PrintField::sheet, "Index of the sheet given; None: of none.")
        .def_readonly("scale", &PrintField::scale, "PrintScale; None: the image is a photo.")
        .def_readonly("spacing_px", &PrintField::spacing_px, "Spacing in the image, in px.")
        .def_readonly("residual_mm", &PrintField::residual_mm,
                      "Rms of the dots from their fitted places, per axis, in mm.")
        .def_readonly("scatter_mm", &PrintField::scatter_mm,
                      "Rms of single dots about their neighbours, per axis, in mm.")
        .def_readonly("largest_distortion_mm", &PrintField::largest_distortion_mm,
                      "Greatest mean displacement of a part of the region, in mm.")
        .def_readonly("cells", &PrintField::cells, "Cells in view and not covered.")
        .def_readonly("missing", &PrintField::missing, "Cells without a dot.")
        .def_readonly("merged", &PrintField::merged, "Dots that touch a neighbour.")
        .def_readonly("covered", &PrintField::covered, "Cells under other print.")
        .def_readonly("dots", &PrintField::dots, "Dots found.")
        .def_readonly("bits_wrong", &PrintField::bits_wrong, "Wrong bits, of two for each dot.")
        .def_readonly("dot_mm", &PrintField::dot_mm, "Median diameter of the dots, in mm.")
        .def_readonly("contrast", &PrintField::contrast, "Darkness of the dots, 0 to 1.")
        .def_property_readonly("gain", &PrintField::gain,
                               "Growth of the dot's diameter over the nominal one.");
}

void define_check_class(py::module_& module) {
    py::class_<SeenCheck>(module, "PrintCheck", "What a scan or photo shows about a print.")
        .def_property_readonly(
            "fields", [](const SeenCheck& c) { return c.check.fields; },
            "Regions of the code, a list of PrintField, the largest first.")
        .def_property_readonly(
            "findings", [](const SeenCheck& c) { return c.check.findings; },
            "Faults and remarks, a list of Finding.")
        .def_property_readonly(
            "is_good",
            [](const SeenCheck& c) {
                for (const Finding& finding : c.check.findings)
                    if (finding.is_fault) return false;
                return !c.check.fields.empty();
            },
            "Whether the pattern was found, without a fault.")
        .def_property_readonly(
            "code", [](const SeenCheck& c) { return name(c.check.code); }, "Code of the page.")
        .def_property_readonly(
            "is_test_page", [](const SeenCheck& c) { return c.check.is_test_page; },
            "Whether the scan shows a test page.")
        .def_property_readonly(
            "best",
            [](const SeenCheck& c) -> std::optional<std::size_t> {
                if (c.check.best_per_spacing.empty()) return std::nullopt;
                return c.check.best;
            },
            "Of a test page: index of the field with the best settings; else None.")
        .def(
            "draw",
            [](const SeenCheck& c, const std::filesystem::path& path) {
                draw_distortion(path, c.scan.view(), c.check);
            },
            "path"_a, "Write a picture (SVG) of how dots are displaced over the page.");
}

SeenCheck check(const py::object& scan, const std::string& code, double spacing_mm,
                const std::optional<double>& dot_mm, const std::optional<double>& displacement_mm,
                const std::optional<std::vector<SheetEntry>>& sheets, bool is_photo,
                const std::optional<double>& dpi, double ink_reflectance) {
    CheckPrintOptions options;
    options.any_code = code == "auto";
    options.pattern =
        pattern_of(options.any_code ? "anoto" : code, spacing_mm, dot_mm, displacement_mm, {0, 0});
    options.ink_reflectance = ink_reflectance;
    options.progress = [](int, int) { return !was_interrupted(); };
    if (sheets) {
        for (const SheetEntry& entry : *sheets)
            options.sheets.push_back(entry.sheet);
    }
    const Frame frame = frame_of(scan);
    return without_lock([&] {
        const auto* path = std::get_if<std::filesystem::path>(&frame);
        SeenCheck seen{{}, path ? read_image(*path) : std::get<GreyImage>(frame)};
        if (dpi) options.resolution = Resolution{*dpi, *dpi};
        if (!dpi && !is_photo && path) {
            const ImageOrigin origin = read_origin(*path);
            options.is_photo = origin.is_photo;
            options.resolution = origin.resolution;
        }
        seen.check = check_print(seen.scan.view(), options);
        return seen;
    });
}

}  // namespace

void define_check(py::module_& module) {
    define_scale(module);
    define_field(module);
    define_check_class(module);
    module.def(
        "check_print", &check, "scan"_a, py::kw_only(), "code"_a = "auto",
        "spacing_mm"_a = kDefaultSpacing_mm, "dot_mm"_a = py::none(),
        "displacement_mm"_a = py::none(), "sheets"_a = py::none(), "is_photo"_a = false,
        "dpi"_a = py::none(), "ink_reflectance"_a = 0.15,
        "Return a PrintCheck of the scan or photo of a printed sheet: an array or the name of an "
        "image file.\n\n"
        "dpi: resolution of the scan; default: that of the file, if it states one. Without it,\n"
        "with is_photo, or with a camera's EXIF data, the image counts as a photo, and scale is\n"
        "not judged.\n"
        "sheets: entries of the sheets that may be seen. ink_reflectance: of solid ink, relative "
        "to paper, 0 to 0.9.");
}

}  // namespace dotpose::python
