#include "dotpose/print.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "commands.hpp"
#include "common.hpp"
#include "progress.hpp"

namespace dotpose::cli {
namespace {

struct PrintArguments {
    std::string out;
    std::string paper = "A4";
    bool landscape = false;
    SheetOptions sheet;
    PatternArguments pattern;
    std::optional<double> margin_mm;
    int pages = 1;
    PrintOptions print;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose print -o sheet.pdf\n"
    "  dotpose print -o sheet.svg\n"
    "  dotpose print -o tiles.pdf --pages 12 --origin 5000,0\n"
    "  dotpose print -o poster.png --paper A3 --landscape --origin 1000,2000 --dpi 1200\n\n"
    "Print at 100 %, without \"fit to page\". Give each sheet an origin of its own.\n";

bool has_resolution(PrintFormat format) {
    return format != PrintFormat::text && format != PrintFormat::svg;
}

/// Labels and rulers of a PDF need more room than printers leave white.
double default_margin_mm(PrintFormat format, const Paper& paper) {
    constexpr double kWithLabels_mm = 10;
    constexpr double kSmallPage_mm = 60;
    const bool is_small = std::min(paper.width_mm, paper.height_mm) < kSmallPage_mm;
    return format == PrintFormat::pdf && !is_small ? kWithLabels_mm : SheetOptions{}.margin_mm;
}

std::string summary(const PrintArguments& arguments, const std::string& prefix,
                    const Sheet& sheet) {
    std::string line = prefix + region_text(sheet);
    if (has_resolution(print_format(arguments.out))) {
        line += fmt::format(", {:g} dpi", arguments.print.dpi);
    }
    return line;
}

void run(const PrintArguments& arguments) {
    SheetOptions options = arguments.sheet;
    options.pattern = arguments.pattern.pattern();
    options.paper = paper_by_name(arguments.paper);
    if (arguments.landscape) options.paper = landscape(options.paper);
    const PrintFormat format = print_format(arguments.out);
    options.margin_mm = arguments.margin_mm.value_or(default_margin_mm(format, options.paper));
    const std::vector<Sheet> sheets = make_sheets(options, arguments.pages);

    catch_interrupts();
    {
        ProgressLine line("printing " + arguments.out);
        PrintOptions print_options = arguments.print;
        print_options.name = std::filesystem::path(arguments.out).stem().string();
        print_options.command = command_line();
        print_options.progress = [&line](int rows_done, int rows) {
            line.update(rows_done, rows);
            return !interrupted();
        };
        write_sheets(sheets, arguments.out, print_options);
    }
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const std::string page =
            sheets.size() > 1 ? fmt::format("{}/{}, ", i + 1, sheets.size()) : "";
        fmt::print("{}\n", summary(arguments, arguments.out + ": " + page, sheets[i]));
    }
}

}  // namespace

void add_print(CLI::App& app, int& /*exit_code*/) {
    const auto arguments = std::make_shared<PrintArguments>();
    CLI::App* command = app.add_subcommand("print", "Make a sheet of dots to print");
    command->footer(kExamples);
    command->add_option("-o,--out", arguments->out, "File to write: .pdf, .svg, .png, .tif or .txt")
        ->type_name("FILE")
        ->required();
    command
        ->add_option("--paper", arguments->paper,
                     "A0 to A6, Letter, Legal, Tabloid or WIDTHxHEIGHT in mm")
        ->type_name("SIZE")
        ->capture_default_str();
    command->add_flag("--landscape", arguments->landscape, "Longer side across");
    command->add_option("--margin", arguments->margin_mm, "Kept free of dots on all sides")
        ->type_name("MM")
        ->default_str("5, in a .pdf 10 on pages over 60 mm");
    command->add_option("--pages", arguments->pages, "Pages of a .pdf, each with cells of its own")
        ->type_name("N")
        ->capture_default_str();
    arguments->pattern.add_to(*command);
    add_cell_option(*command, "--origin", arguments->sheet.origin,
                    "Cell of the code plane at the top left");
    command->add_option("--dpi", arguments->print.dpi, "The printer's own resolution")
        ->type_name("N")
        ->capture_default_str();
    add_drawing_option(*command, arguments->print.drawing);
    command->add_flag("!--no-labels", arguments->print.labels,
                      "No text and rulers in the margins of a .pdf");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
