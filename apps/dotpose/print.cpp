#include "dotpose/print.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/test_page.hpp"
#include "progress.hpp"

namespace dotpose::cli {
namespace {

struct PrintArguments {
    std::string out;
    std::string paper = "A4";
    bool landscape = false;
    bool test_page = false;
    SheetOptions sheet;
    PatternArguments pattern;
    double dpi = PrintOptions{}.dpi;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose print -o sheet.svg\n"
    "  dotpose print -o poster.png --paper A3 --landscape --origin 1000,2000 --dpi 1200\n"
    "  dotpose print -o test.svg --test-page\n\n"
    "Print at 100 %, without \"fit to page\". Give each sheet an origin of its own.\n";

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
    return line;
}

/// Runs `write` with progress on the terminal and an ear for Ctrl-C.
template <typename Write>
void with_progress(const PrintArguments& arguments, const Write& write) {
    catch_interrupts();
    ProgressLine line("printing " + arguments.out);
    PrintOptions options;
    options.dpi = arguments.dpi;
    options.progress = [&line](int done, int total) {
        line.update(done, total);
        return !interrupted();
    };
    write(options);
}

void print_test_page(const PrintArguments& arguments, const Paper& paper) {
    TestPageOptions options;
    options.profile = arguments.pattern.pattern().profile;
    options.paper = paper;
    options.margin_mm = std::max(options.margin_mm, arguments.sheet.margin_mm);
    const PrintPage page = make_test_page(options);
    with_progress(arguments, [&](const PrintOptions& print_options) {
        write_page(page, arguments.out, print_options);
    });
    fmt::print(
        "{}: test page {:g} x {:g} mm, {} patches; print it, scan it, then run: dotpose "
        "check-print SCAN\n",
        arguments.out, page.width_mm, page.height_mm, page.sheets.size());
}

void run(const PrintArguments& arguments) {
    Paper paper = paper_by_name(arguments.paper);
    if (arguments.landscape) paper = landscape(paper);
    if (arguments.test_page) return print_test_page(arguments, paper);
    SheetOptions options = arguments.sheet;
    options.pattern = arguments.pattern.pattern();
    options.paper = paper;
    const Sheet sheet = make_sheet(options);
    with_progress(arguments, [&](const PrintOptions& print_options) {
        write_sheet(sheet, arguments.out, print_options);
    });
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
    command->add_option("--dpi", arguments->dpi, "Resolution of .png and .tif: the printer's own")
        ->type_name("N")
        ->capture_default_str();
    CLI::Option* test_page = command->add_flag(
        "--test-page", arguments->test_page,
        "Patches of dot sizes and spacings, to find what suits a printer with check-print");
    for (const char* own : {"--spacing", "--dot", "--displacement", "--origin", "--section"})
        test_page->excludes(command->get_option(own));
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
