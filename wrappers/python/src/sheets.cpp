// Bindings for Sheet, SheetEntry and SheetFile: printed sheets, and poses of pages in the world.
#include "sheets.hpp"

#include <memory>
#include <utility>

#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/files/error.hpp"
#include "progress.hpp"

namespace dotpose::python {
namespace {

py::tuple pair_of(const Cell& cell) {
    return py::make_tuple(cell.x, cell.y);
}

/// A SheetFile that is open during a `with` block. Saved at the end of the block, unless the block
/// raises an exception.
class OpenSheetFile {
  public:
    OpenSheetFile(std::filesystem::path path, double max_s) : path_(std::move(path)) {
        wait_.max_s = max_s;
        wait_.stop = was_interrupted;
    }

    OpenSheetFile& enter() {
        file_ = without_lock([this] { return std::make_unique<SheetFile>(path_, wait_); });
        return *this;
    }
    void leave(const py::object& error) {
        const std::unique_ptr<SheetFile> file = std::move(file_);
        if (file && error.is_none()) file->save();
    }
    SheetFile& file() {
        if (!file_)
            throw Error("a SheetFile can only be changed in a block: with SheetFile(...) as file");
        return *file_;
    }

  private:
    std::filesystem::path path_;
    SheetFileWait wait_;
    std::unique_ptr<SheetFile> file_;
};

void define_sheet(py::module_& module) {
    py::class_<Sheet>(
        module, "Sheet",
        "A page with columns x rows intersections of the pattern. The first intersection is "
        "the origin.\n\nThe sheet frame is in mm from the top left corner of the "
        "page, x to the right, y DOWN.")
        .def_property_readonly(
            "code", [](const Sheet& s) { return name(s.pattern.code); }, "Code of the dots.")
        .def_property_readonly(
            "section",
            [](const Sheet& s) { return py::make_tuple(s.pattern.section.u, s.pattern.section.v); },
            "Section (u, v).")
        .def_property_readonly(
            "spacing_mm", [](const Sheet& s) { return s.pattern.spacing_mm; },
            "Spacing of the grid, in mm.")
        .def_property_readonly(
            "displacement_mm", [](const Sheet& s) { return s.pattern.displacement_mm; },
            "Distance of a dot from its intersection, in mm.")
        .def_property_readonly(
            "dot_mm", [](const Sheet& s) { return s.pattern.dot_mm; }, "Diameter of a dot, in mm.")
        .def_property_readonly(
            "origin", [](const Sheet& s) { return pair_of(s.origin); },
            "Cell (x, y) at the top left.")
        .def_readonly("columns", &Sheet::columns, "Number of columns of intersections.")
        .def_readonly("rows", &Sheet::rows, "Number of rows of intersections.")
        .def_readonly("width_mm", &Sheet::width_mm, "Width of the page, in mm.")
        .def_readonly("height_mm", &Sheet::height_mm, "Height of the page, in mm.")
        .def_readonly("origin_x_mm", &Sheet::origin_x_mm,
                      "x of the first intersection on the page, in mm.")
        .def_readonly("origin_y_mm", &Sheet::origin_y_mm,
                      "y of the first intersection on the page, in mm.")
        .def("__repr__", [](const Sheet& s) {
            return fmt::format("<Sheet {:g} x {:g} mm, {} x {} cells from ({}, {}), code {}>",
                               s.width_mm, s.height_mm, s.columns, s.rows, s.origin.x, s.origin.y,
                               name(s.pattern.code));
        });
}

void define_entry(py::module_& module) {
    py::class_<WorldPose>(module, "WorldPose",
                          "Position and direction of a page in the world: m, y up, angles "
                          "counter-clockwise.")
        .def(py::init([](double x_m, double y_m, double yaw_rad) {
                 return WorldPose{x_m, y_m, yaw_rad};
             }),
             "x_m"_a, "y_m"_a, "yaw_rad"_a = 0.0)
        .def_readwrite("x_m", &WorldPose::x_m, "x of the top left corner, in m.")
        .def_readwrite("y_m", &WorldPose::y_m, "y of the top left corner, in m.")
        .def_readwrite("yaw_rad", &WorldPose::yaw_rad, "Direction of the upper edge, in rad.");
    py::class_<SheetEntry>(module, "SheetEntry", "One page of a sheet file.")
        .def(py::init([](std::string name, const Sheet& sheet) {
                 SheetEntry entry;
                 entry.name = std::move(name);
                 entry.sheet = sheet;
                 return entry;
             }),
             "name"_a, "sheet"_a)
        .def_readwrite("name", &SheetEntry::name, "Name of the page, unique in the file.")
        .def_readwrite("page", &SheetEntry::page,
                       "Number of the page among pages printed together, from 1.")
        .def_readwrite("sheet", &SheetEntry::sheet, "The page.")
        .def_readwrite("print_scale_x", &SheetEntry::print_scale_x,
                       "Ratio of printed to nominal length along x.")
        .def_readwrite("print_scale_y", &SheetEntry::print_scale_y,
                       "Ratio of printed to nominal length along y.")
        .def_readwrite("world", &SheetEntry::world, "WorldPose of the page; None if unknown.")
        .def_readonly("is_reserved", &SheetEntry::is_reserved,
                      "True if the region is reserved but the page may not exist.")
        .def("__repr__", [](const SheetEntry& e) {
            return fmt::format("<SheetEntry '{}', {} x {} cells from ({}, {})>", e.name,
                               e.sheet.columns, e.sheet.rows, e.sheet.origin.x, e.sheet.origin.y);
        });
}

void define_file(py::module_& module) {
    module.def("read_sheets", &read_sheets, "path"_a,
               "Return the entries of a sheet file, a list of SheetEntry.");
    py::class_<OpenSheetFile>(
        module, "SheetFile",
        "Changes a sheet file. Other writers wait until the end of the block, where the file is\n"
        "saved unless an exception was raised.\n\n"
        "    with dotpose.SheetFile(\"sheets.json\") as file:\n"
        "        file.allocate(\"table\", dotpose.make_sheet(\"A3\"))")
        .def(py::init<std::filesystem::path, double>(), "path"_a, "wait_s"_a = 60.0,
             "Set the path of the sheet file, which need not exist, and the time to wait for other "
             "writers.")
        .def("__enter__", &OpenSheetFile::enter, py::return_value_policy::reference_internal)
        .def("__exit__", [](OpenSheetFile& self, const py::object& type, const py::object&,
                            const py::object&) { self.leave(type); })
        .def_property_readonly(
            "sheets", [](OpenSheetFile& self) { return self.file().sheets(); },
            "The entries, a list of SheetEntry.")
        .def(
            "allocate",
            [](OpenSheetFile& self, const std::string& name, const Sheet& sheet, int count) {
                return self.file().allocate(name, sheet, count);
            },
            "name"_a, "sheet"_a, "count"_a = 1,
            "Add copies of a sheet, each in the next free region of the code. Several copies are "
            "named "
            "name-1, name-2, ... Return their entries.")
        .def(
            "add", [](OpenSheetFile& self, const SheetEntry& e) { self.file().add(e); }, "entry"_a,
            "Add a page with a given region.")
        .def(
            "replace", [](OpenSheetFile& self, const SheetEntry& e) { self.file().replace(e); },
            "entry"_a, "Replace the page with the name of the entry.")
        .def(
            "rename",
            [](OpenSheetFile& self, const std::string& name, const std::string& new_name) {
                self.file().rename(name, new_name);
            },
            "name"_a, "new_name"_a, "Rename a page.")
        .def(
            "remove",
            [](OpenSheetFile& self, const std::string& name) { self.file().remove(name); },
            "name"_a, "Remove the page with this name, if any.")
        .def(
            "save", [](OpenSheetFile& self) { self.file().save(); },
            "Write the file now, atomically.");
}

void define_place(py::module_& module) {
    py::class_<WorldPlace>(module, "WorldPlace",
                           "The place of a fix in the world: m, y up, angles counter-clockwise.")
        .def_readonly("x_m", &WorldPlace::x_m, "x in the world, in m.")
        .def_readonly("y_m", &WorldPlace::y_m, "y in the world, in m.")
        .def_readonly("yaw_rad", &WorldPlace::yaw_rad, "Direction of the image x axis, in rad.")
        .def_property_readonly(
            "covariance", [](const WorldPlace& p) { return array_of(p.covariance); },
            "Covariance of (x_m, y_m, yaw_rad), 3 x 3.");
    py::class_<SeenPlace>(module, "SheetPlace",
                          "The place of a fix on a page: mm from the top left corner, y DOWN.")
        .def_readonly("entry", &SeenPlace::entry, "Entry of the page.")
        .def_property_readonly(
            "name", [](const SeenPlace& p) { return p.entry.name; }, "Name of the page.")
        .def_property_readonly(
            "x_mm", [](const SeenPlace& p) { return p.place.x_mm; },
            "x on the printed page, in mm.")
        .def_property_readonly(
            "y_mm", [](const SeenPlace& p) { return p.place.y_mm; },
            "y on the printed page, in mm.")
        .def_property_readonly(
            "theta_rad", [](const SeenPlace& p) { return p.place.theta_rad; },
            "Angle of the image x axis, clockwise on the page, in rad.")
        .def_property_readonly(
            "covariance", [](const SeenPlace& p) { return array_of(p.place.covariance); },
            "Covariance of (x_mm, y_mm, theta_rad), 3 x 3.")
        .def_property_readonly(
            "world",
            [](const SeenPlace& p) {
                SheetPlace place = p.place;
                place.entry = &p.entry;
                return world_place(place);
            },
            "WorldPlace of the fix; None if the pose of the page is unknown.")
        .def("__repr__", [](const SeenPlace& p) {
            return fmt::format("<SheetPlace '{}': x {:.3f} mm, y {:.3f} mm>", p.entry.name,
                               p.place.x_mm, p.place.y_mm);
        });
}

}  // namespace

Cell cell_of(const Whole& pair) {
    for (const std::int64_t value : pair)
        if (value < 0 || value >= std::int64_t{kPositionsPerAxis})
            throw BadArgument("origin: " + std::to_string(value) + " is not a cell of the pattern");
    return {static_cast<std::uint32_t>(pair[0]), static_cast<std::uint32_t>(pair[1])};
}

Section section_of_pair(const Whole& pair) {
    for (const std::int64_t value : pair)
        if (value < 0 || value >= kSections)
            throw BadArgument("section: " + std::to_string(value) + " is not 0 to 62");
    return {static_cast<std::uint8_t>(pair[0]), static_cast<std::uint8_t>(pair[1])};
}

Pattern pattern_of(const std::string& code, double spacing_mm, const std::optional<double>& dot_mm,
                   const std::optional<double>& displacement_mm, const Whole& section) {
    return {code_named(code), section_of_pair(section), spacing_mm,
            displacement_mm.value_or(spacing_mm / 6), dot_mm.value_or(spacing_mm / 6)};
}

DotDrawing drawing_named(const std::string& name) {
    if (name == "auto") return DotDrawing::automatic;
    if (name == "glyphs") return DotDrawing::glyphs;
    if (name == "strokes") return DotDrawing::strokes;
    throw BadArgument("dots: '" + name + "' is none of auto, glyphs, strokes");
}

std::optional<SeenPlace> seen_place(const std::optional<SheetPlace>& place) {
    if (!place) return std::nullopt;
    SeenPlace seen{*place, *place->entry};
    seen.place.entry = nullptr;
    return seen;
}

py::array_t<double> array_of(const PoseCovariance& covariance) {
    py::array_t<double> array({3, 3});
    auto at = array.mutable_unchecked<2>();
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            at(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(j)) = double{covariance[i][j]};
    return array;
}

void define_sheets(py::module_& module) {
    define_sheet(module);
    define_entry(module);
    define_file(module);
    define_place(module);
}

}  // namespace dotpose::python
