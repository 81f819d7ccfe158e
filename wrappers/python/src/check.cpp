// Bindings for check_print, which checks printer and paper with a scan or photo of a printed sheet.
#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/tools/check_print.hpp"
#include "dotpose/tools/draw.hpp"
#include "frames.hpp"
#include "progress.hpp"
#include "sheets.hpp"

namespace dotpose::python {
namespace {

/// Result of a check, and the scan on which it is drawn.
struct SeenCheck {
    PrintCheck check;
    GreyImage scan;
};

void define_scale(py::module_& module) {
    py::class_<PrintScale>(
        module, "PrintScale",
        "Scale and angles of a print on a flatbed scan, including those of the scanner.")
        .def_readonly("scale_x", &PrintScale::scale_x,
                      "Ratio of printed to nominal length along x.")
        .def_readonly("scale_y", &PrintScale::scale_y,
                      "Ratio of printed to nominal length along y.")
        .def_readonly("rotation_rad", &PrintScale::rotation_rad,
                      "Direction of the pattern's x axis in the scan, in rad.")
        .def_readonly("skew_rad", &PrintScale::skew_rad,
                      "Angle between the axes minus 90 degrees, in rad.");
    py::class_<Finding>(module, "Finding", "One fault or remark about a print.")
        .def_property_readonly(
            "kind", [](const Finding& f) { return name(f.kind); },
            "Identifier, such as \"uneven_scale\"; \"good\" if there is no fault.")
        .def_readonly("is_fault", &Finding::is_fault, "True for a fault that should be corrected.")
        .def_readonly("field", &Finding::field,
                      "Index of the field concerned; None for the whole scan.")
        .def_readonly("text", &Finding::text,
                      "Description of the fault, the likely cause and the remedy.")
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
            "Section (u, v) of the field.")
        .def_property_readonly(
            "origin", [](const PrintField& f) { return py::make_tuple(f.origin.x, f.origin.y); },
            "First cell (x, y) of the region.")
        .def_readonly("columns", &PrintField::columns, "Number of columns of the region.")
        .def_readonly("rows", &PrintField::rows, "Number of rows of the region.")
        .def_readonly("is_patch", &PrintField::is_patch, "True for a patch of a test page.")
        .def_readonly("sheet", &PrintField::sheet,
                      "Index of the sheet in `sheets`; None for other regions.")
        .def_readonly("scale", &PrintField::scale, "PrintScale; None for a photo.")
        .def_readonly("spacing_px", &PrintField::spacing_px, "Spacing in the image, in px.")
        .def_readonly("residual_mm", &PrintField::residual_mm,
                      "Rms distance of the dots from their fitted positions, per axis, in mm.")
        .def_readonly("scatter_mm", &PrintField::scatter_mm,
                      "Rms displacement of dots relative to their neighbours, per axis, in mm.")
        .def_readonly("largest_distortion_mm", &PrintField::largest_distortion_mm,
                      "Largest mean displacement in any part of the region, in mm.")
        .def_readonly("cells", &PrintField::cells, "Number of cells in view that are not covered.")
        .def_readonly("missing", &PrintField::missing, "Number of cells without a dot.")
        .def_readonly("merged", &PrintField::merged, "Number of dots that touch a neighbour.")
        .def_readonly("covered", &PrintField::covered, "Number of cells covered by other print.")
        .def_readonly("dots", &PrintField::dots, "Number of dots found.")
        .def_readonly("bits_wrong", &PrintField::bits_wrong,
                      "Number of wrong bits. Each dot has two bits.")
        .def_readonly("dot_mm", &PrintField::dot_mm, "Median diameter of the dots, in mm.")
        .def_readonly("contrast", &PrintField::contrast, "Darkness of the dots, 0 to 1.")
        .def_property_readonly(
            "gain", &PrintField::gain,
            "Dot gain: ratio of the printed to the nominal diameter of the dots, minus 1.");
}

void define_check_class(py::module_& module) {
    py::class_<SeenCheck>(module, "PrintCheck",
                          "The result of checking a scan or photo of a print.")
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
            "True if the pattern was found without a fault.")
        .def_property_readonly(
            "code", [](const SeenCheck& c) { return name(c.check.code); }, "Code of the page.")
        .def_property_readonly(
            "is_test_page", [](const SeenCheck& c) { return c.check.is_test_page; },
            "True if the scan shows a test page.")
        .def_property_readonly(
            "best",
            [](const SeenCheck& c) -> std::optional<std::size_t> {
                if (c.check.best_per_spacing.empty()) return std::nullopt;
                return c.check.best;
            },
            "Index of the field of a test page with the best settings; None for other pages.")
        .def(
            "draw",
            [](const SeenCheck& c, const std::filesystem::path& path) {
                draw_distortion(path, c.scan.view(), c.check);
            },
            "path"_a, "Write a picture (SVG) of the displacements of the dots over the page.");
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
        "dpi: resolution of the scan; default: the resolution stated in the file. Without a\n"
        "resolution, with is_photo, or with EXIF data of a camera, the image is treated as a\n"
        "photo, and its scale is not checked.\n"
        "sheets: entries of the sheets that the scan may show. ink_reflectance: reflectance of "
        "solid ink, relative to paper, 0 to 0.9.");
}

}  // namespace dotpose::python
