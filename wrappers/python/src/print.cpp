// Bindings for printing: lays out and writes sheets, and adds dots to the pages of an existing PDF.
#include "dotpose/tools/print.hpp"

#include <span>
#include <vector>

#include <fmt/core.h>

#include "dotpose/tools/overlay.hpp"
#include "progress.hpp"
#include "sheets.hpp"

namespace dotpose::python {
namespace {

using Path = std::filesystem::path;

/// Reserves regions for sheets in a sheet file before the pages are written. Does nothing if no
/// sheet file is given.
class Entering {
  public:
    Entering(const std::optional<Path>& file, const std::optional<std::string>& name)
        : file_(file), name_(name.value_or("")) {
        if (file.has_value() != name.has_value()) {
            throw BadArgument("sheet_file and name go together");
        }
        wait_.stop = was_interrupted;
    }

    /// Assigns the next free region to each sheet. The previous origins of the sheets are ignored.
    void reserve(std::span<Sheet*> sheets) {
        if (!file_) return;
        const auto enter_all = [&](SheetFile& file) {
            for (std::size_t i = 0; i < sheets.size(); ++i) {
                SheetEntry entry;
                entry.page = static_cast<int>(i + 1);
                entry.name = sheets.size() == 1 ? name_ : fmt::format("{}-{}", name_, entry.page);
                entry.sheet = *sheets[i];
                *sheets[i] = file.allocate(entry).sheet;
            }
        };
        reservation_.emplace(*file_, enter_all, wait_);
    }

    void confirm() {
        if (reservation_) reservation_->confirm();
    }

  private:
    std::optional<Path> file_;
    std::string name_;
    SheetFileWait wait_;
    std::optional<SheetReservation> reservation_;
};

SheetOptions layout_of(const std::string& paper, bool is_landscape, double margin_mm,
                       const Whole& origin, const Pattern& pattern) {
    SheetOptions options;
    options.pattern = pattern;
    options.origin = cell_of(origin);
    options.paper = paper_by_name(paper);
    if (is_landscape) options.paper = landscape(options.paper);
    options.margin_mm = margin_mm;
    return options;
}

/// Returns the print options. The default title is the name of the file.
PrintOptions options_of(const Path& path, double dpi, const std::string& dots, bool labels,
                        const std::optional<std::string>& title) {
    PrintOptions options;
    options.dpi = dpi;
    options.drawing = drawing_named(dots);
    options.labels = labels;
    options.name = title.value_or(path.stem().string());
    options.progress = [](int, int) { return !was_interrupted(); };
    return options;
}

std::vector<Sheet> print_sheets(const Path& path, std::vector<Sheet> sheets,
                                const PrintOptions& options, Entering& entering) {
    std::vector<Sheet*> all;
    for (Sheet& sheet : sheets)
        all.push_back(&sheet);
    without_lock([&] {
        print_format(path);
        entering.reserve(all);
        write_sheets(sheets, path, options);
        entering.confirm();
    });
    return sheets;
}

using Length = std::optional<double>;

std::vector<Sheet> make_all(int pages, const std::string& paper, bool is_landscape,
                            double margin_mm, const Whole& origin, const Whole& section,
                            const std::string& code, double spacing_mm, const Length& dot_mm,
                            const Length& displacement_mm) {
    const Pattern pattern = pattern_of(code, spacing_mm, dot_mm, displacement_mm, section);
    return make_sheets(layout_of(paper, is_landscape, margin_mm, origin, pattern), pages);
}

void define_layout(py::module_& module) {
    module.def(
        "make_sheet",
        [](const std::string& paper, bool landscape, double margin_mm, const Whole& origin,
           const Whole& section, const std::string& code, double spacing_mm, const Length& dot_mm,
           const Length& displacement_mm) {
            return make_all(1, paper, landscape, margin_mm, origin, section, code, spacing_mm,
                            dot_mm, displacement_mm)
                .front();
        },
        "paper"_a = "A4", py::kw_only(), "landscape"_a = false, "margin_mm"_a = 5.0,
        "origin"_a = Whole{0, 0}, "section"_a = Whole{0, 0}, "code"_a = "anoto",
        "spacing_mm"_a = kDefaultSpacing_mm, "dot_mm"_a = py::none(),
        "displacement_mm"_a = py::none(),
        "Return a Sheet that fills a page with whole cells.\n\n"
        "paper: A0 to A6, Letter, Legal, Tabloid, or WIDTHxHEIGHT in mm.\n"
        "margin_mm: margin without ink on all sides.\n"
        "origin: cell (x, y) at the top left; should be different for each sheet.\n"
        "section: (u, v), each 0 to 62.\n"
        "dot_mm, displacement_mm: diameter of a dot, and its distance from the intersection; a "
        "sixth of the spacing by default.");
    module.def("make_sheets", &make_all, "pages"_a, "paper"_a = "A4", py::kw_only(),
               "landscape"_a = false, "margin_mm"_a = 5.0, "origin"_a = Whole{0, 0},
               "section"_a = Whole{0, 0}, "code"_a = "anoto", "spacing_mm"_a = kDefaultSpacing_mm,
               "dot_mm"_a = py::none(), "displacement_mm"_a = py::none(),
               "Return sheets with adjacent regions, laid out as by make_sheet.");
}

void define_printing(py::module_& module) {
    module.def(
        "print_sheets",
        [](const Path& path, const std::vector<Sheet>& sheets, double dpi, const std::string& dots,
           bool labels, const std::optional<std::string>& title,
           const std::optional<Path>& sheet_file, const std::optional<std::string>& name) {
            Entering entering(sheet_file, name);
            return print_sheets(path, sheets, options_of(path, dpi, dots, labels, title), entering);
        },
        "path"_a, "sheets"_a, py::kw_only(), "dpi"_a = 600.0, "dots"_a = "auto", "labels"_a = true,
        "title"_a = py::none(), "sheet_file"_a = py::none(), "name"_a = py::none(),
        "Write a PDF of several pages, as print_sheet does. Return the sheets as written.");
    module.def(
        "print_sheet",
        [](const Path& path, const std::optional<Sheet>& sheet, double dpi, const std::string& dots,
           bool labels, const std::optional<std::string>& title,
           const std::optional<Path>& sheet_file, const std::optional<std::string>& name) {
            Entering entering(sheet_file, name);
            return print_sheets(path, {sheet ? *sheet : make_sheet({})},
                                options_of(path, dpi, dots, labels, title), entering)
                .front();
        },
        "path"_a, "sheet"_a = py::none(), py::kw_only(), "dpi"_a = 600.0, "dots"_a = "auto",
        "labels"_a = true, "title"_a = py::none(), "sheet_file"_a = py::none(),
        "name"_a = py::none(),
        "Write a sheet (default: that of make_sheet) as .pdf, .svg, .png, .tif or .txt, "
        "atomically. Return the sheet as written. Print it at 100 %.\n\n"
        "dpi: native resolution of the printer. dots: in a PDF, \"auto\", \"glyphs\" or "
        "\"strokes\".\n"
        "labels: text and rulers in the margins of a PDF.\n"
        "sheet_file, name: also add the sheet to a sheet file, with the next free region of the "
        "code instead of the given origin.");
}

py::tuple numbered(const OverlaidPage& page) {
    return py::make_tuple(page.number, page.sheet);
}

struct OverlayArguments {
    Path in, out;
    OverlayOptions options;
    std::optional<Path> sheet_file;
    std::optional<std::string> name;
};

OverlayReport run(OverlayArguments& arguments) {
    Entering entering(arguments.sheet_file, arguments.name);
    arguments.options.progress = [](int, int) { return !was_interrupted(); };
    if (arguments.sheet_file) {
        arguments.options.place = [&entering](std::span<OverlaidPage> pages) {
            std::vector<Sheet*> sheets;
            for (OverlaidPage& page : pages)
                sheets.push_back(&page.sheet);
            entering.reserve(sheets);
        };
    }
    return without_lock([&] {
        OverlayReport report = overlay_pdf(arguments.in, arguments.out, arguments.options);
        entering.confirm();
        return report;
    });
}

void define_overlay(py::module_& module) {
    py::class_<OverlayReport>(module, "OverlayReport", "The result of laying dots over a document.")
        .def_property_readonly(
            "pages",
            [](const OverlayReport& report) {
                py::list pages;
                for (const OverlaidPage& page : report.pages)
                    pages.append(numbered(page));
                return pages;
            },
            "Pages with dots: a list of (number from 1, Sheet).")
        .def_readonly("warnings", &OverlayReport::warnings,
                      "Warnings about content that may hide dots or was not converted.");
    module.def(
        "overlay",
        [](const Path& document, const Path& path, const std::string& pages, const Whole& origin,
           const Whole& section, const std::string& code, double spacing_mm, const Length& dot_mm,
           const Length& displacement_mm, double margin_mm, double dpi, const std::string& dots,
           bool under, bool cmy_black, double lighten, const std::string& password,
           const std::optional<Path>& sheet_file, const std::optional<std::string>& name) {
            OverlayArguments arguments{document, path, {}, sheet_file, name};
            OverlayOptions& options = arguments.options;
            options.pattern = pattern_of(code, spacing_mm, dot_mm, displacement_mm, section);
            options.origin = cell_of(origin);
            options.margin_mm = margin_mm;
            options.dpi = dpi;
            options.drawing = drawing_named(dots);
            options.pages = pages;
            options.under = under;
            options.black_to_cmy = cmy_black;
            options.lighten = lighten;
            options.password = password;
            return run(arguments);
        },
        "document"_a, "path"_a, py::kw_only(), "pages"_a = "", "origin"_a = Whole{0, 0},
        "section"_a = Whole{0, 0}, "code"_a = "anoto", "spacing_mm"_a = kDefaultSpacing_mm,
        "dot_mm"_a = py::none(), "displacement_mm"_a = py::none(), "margin_mm"_a = 5.0,
        "dpi"_a = 600.0, "dots"_a = "auto", "under"_a = false, "cmy_black"_a = false,
        "lighten"_a = 0.0, "password"_a = "", "sheet_file"_a = py::none(), "name"_a = py::none(),
        "Lay dots over the pages of a PDF and write it to path. Return an OverlayReport.\n\n"
        "pages: pages that get dots, such as \"1-3,7\"; \"z\" is the last; default: all.\n"
        "under: dots below the document instead of above. cmy_black: print the document's black "
        "without black ink. lighten: fraction of the ink removed from the document, 0 to under 1.\n"
        "Other arguments: see make_sheet and print_sheet.");
}

}  // namespace

void define_print(py::module_& module) {
    define_layout(module);
    define_printing(module);
    define_overlay(module);
}

}  // namespace dotpose::python
