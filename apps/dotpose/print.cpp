#include "dotpose/print.hpp"

#include <cstdio>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/sheet_file.hpp"
#include "progress.hpp"

namespace dotpose::cli {
namespace {

struct PrintArguments {
    std::string out;
    std::string paper = "A4";
    bool landscape = false;
    SheetOptions sheet;
    PatternArguments pattern;
    double dpi = PrintOptions{}.dpi;
    std::string sheets;  ///< sheet file; empty: none
    std::string name;
    bool origin_given = false;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose print -o sheet.svg\n"
    "  dotpose print -o poster.png --paper A3 --landscape --origin 1000,2000 --dpi 1200\n"
    "  dotpose print -o table.svg --sheets sheets.json --name table\n\n"
    "Print at 100 %, without \"fit to page\". Give each sheet an origin of its own, or let a\n"
    "sheet file do so: it is made if missing, and 'dotpose locate --sheets' reads it.\n";

bool is_raster(PrintFormat format) {
    return format == PrintFormat::png || format == PrintFormat::tiff;
}

std::string summary(const PrintArguments& arguments, const Sheet& sheet) {
    const Pattern& pattern = sheet.pattern;
    std::string line = fmt::format(
        "{}: page {:g} x {:g} mm, cells {},{} to {},{} ({} x {}), spacing {:g} mm, section {},{}, "
        "code {}",
        arguments.out, sheet.width_mm, sheet.height_mm, sheet.origin.x, sheet.origin.y,
        sheet.origin.x + static_cast<std::uint32_t>(sheet.columns - 1),
        sheet.origin.y + static_cast<std::uint32_t>(sheet.rows - 1), sheet.columns, sheet.rows,
        pattern.spacing_mm, pattern.section.u, pattern.section.v, profile_name(pattern.profile));
    if (is_raster(print_format(arguments.out))) line += fmt::format(", {:g} dpi", arguments.dpi);
    if (!arguments.sheets.empty()) {
        line += fmt::format(", sheet '{}' of {}", arguments.name, arguments.sheets);
    }
    return line;
}

/// The sheet, where it stands now that it is in the file: in the next free region unless the user
/// chose one.
Sheet add_to(SheetFile& file, const PrintArguments& arguments, const Sheet& sheet) {
    if (!arguments.origin_given) return file.allocate(arguments.name, sheet).front().sheet;
    SheetEntry entry;
    entry.name = arguments.name;
    entry.sheet = sheet;
    file.add(entry);
    return sheet;
}

void run(const PrintArguments& arguments) {
    SheetOptions options = arguments.sheet;
    options.pattern = arguments.pattern.pattern();
    options.paper = paper_by_name(arguments.paper);
    if (arguments.landscape) options.paper = landscape(options.paper);
    Sheet sheet = make_sheet(options);
    std::optional<SheetFile> sheet_file;
    if (!arguments.sheets.empty()) {
        sheet_file.emplace(arguments.sheets);
        sheet = add_to(*sheet_file, arguments, sheet);
    }

    catch_interrupts();
    {
        ProgressLine line("printing " + arguments.out);
        PrintOptions print_options;
        print_options.dpi = arguments.dpi;
        print_options.progress = [&line](int rows_done, int rows) {
            line.update(rows_done, rows);
            return !interrupted();
        };
        write_sheet(sheet, arguments.out, print_options);
    }
    if (sheet_file) sheet_file->save();
    fmt::print("{}\n", summary(arguments, sheet));
}

}  // namespace

void add_print(CLI::App& app, int& /*exit_code*/) {
    const auto arguments = std::make_shared<PrintArguments>();
    CLI::App* command = app.add_subcommand("print", "Make a sheet of dots to print");
    command->footer(kExamples);
    command->add_option("-o,--out", arguments->out, "File to write: .svg, .png, .tif or .txt")
        ->type_name("FILE")
        ->required();
    command
        ->add_option("--paper", arguments->paper,
                     "A0 to A6, Letter, Legal, Tabloid or WIDTHxHEIGHT in mm")
        ->type_name("SIZE")
        ->capture_default_str();
    command->add_flag("--landscape", arguments->landscape, "Longer side across");
    command->add_option("--margin", arguments->sheet.margin_mm, "Kept free of ink on all sides")
        ->type_name("MM")
        ->capture_default_str();
    arguments->pattern.add_to(*command);
    add_cell_option(*command, "--origin", arguments->sheet.origin,
                    "Cell of the code plane at the top left");
    CLI::Option* sheets =
        add_sheets_option(*command, arguments->sheets,
                          "Sheet file to add the sheet to, in a free region unless --origin");
    CLI::Option* name =
        command->add_option("--name", arguments->name, "Name of the sheet in the sheet file");
    name->type_name("NAME")->needs(sheets);
    sheets->needs(name);
    command->add_option("--dpi", arguments->dpi, "Resolution of .png and .tif: the printer's own")
        ->type_name("N")
        ->capture_default_str();
    command->callback([arguments, command] {
        arguments->origin_given = command->count("--origin") > 0;
        run(*arguments);
    });
}

}  // namespace dotpose::cli
