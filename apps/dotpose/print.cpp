#include "dotpose/tools/print.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/write_file.hpp"
#include "dotpose/tools/test_page.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "sheet_entries.hpp"
#include "sheet_print.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

struct PrintArguments {
    std::string out;
    std::string ending;  ///< file extension for --format, such as ".pdf", or empty
    std::string paper = "A4";
    bool landscape = false;
    SheetOptions sheet;
    PatternArguments pattern;
    std::optional<double> margin_mm;
    int pages = 1;
    bool test_page = false;
    SheetEntryArguments entries;
    PrintOptions print;
};

constexpr const char* kPrintExamples =
    "Examples:\n"
    "  dotpose print -o sheet.pdf\n"
    "  dotpose print -o sheet.svg\n"
    "  dotpose print -o tiles.pdf --pages 12 --origin 5000,0\n"
    "  dotpose print -o poster.png --paper A3 --landscape --origin 1000,2000 --dpi 1200\n\n"
    "  dotpose print -o table.pdf --sheets sheets.json --name table\n"
    "  dotpose print -o test.pdf --test-page\n"
    "  dotpose print -o - --format pdf | lp\n\n"
    "Print at 100 %, without \"fit to page\". Give each sheet its own origin, or let a sheet\n"
    "file do so: it is created if missing, and 'dotpose locate --sheets' reads it.\n";

/// Output formats, as file extensions.
const std::vector<std::string> kFormats = {"pdf", "svg", "png", "tif", "txt"};

/// Returns the output format. Throws BadArgument if the format is missing, is unknown, or
/// contradicts the file name.
PrintFormat format_of(const PrintArguments& arguments) {
    if (arguments.out == kStandardOutput) {
        if (arguments.ending.empty()) {
            throw BadArgument("-o - needs --format: " + alternatives(kFormats));
        }
        return print_format("document" + arguments.ending);
    }
    const PrintFormat format = print_format(system::path_of(arguments.out));
    if (!arguments.ending.empty() && print_format("document" + arguments.ending) != format) {
        throw BadArgument(fmt::format("--format {}: the name {} is that of another format",
                                      arguments.ending.substr(1), arguments.out));
    }
    return format;
}

bool has_resolution(PrintFormat format) {
    return format != PrintFormat::text && format != PrintFormat::svg;
}

std::string title_of(const PrintArguments& arguments) {
    if (arguments.entries.given()) return arguments.entries.name();
    if (arguments.out == kStandardOutput) return "sheet";
    return system::path_of(arguments.out).stem().string();
}

/// Returns the print settings to store in a page's entry in the sheet file.
SheetPrint print_of(const PrintArguments& arguments) {
    SheetPrint print;
    print.title = title_of(arguments);
    print.pages = arguments.pages;
    print.dpi = arguments.print.dpi;
    print.dots = drawing_name(arguments.print.drawing);
    print.has_labels = arguments.print.labels;
    print.command = command_line(SheetEntryArguments::options_of_entering());
    return print;
}

/// Runs `write` and shows its progress. Ctrl-C cancels `write`.
template <typename Write>
void with_progress(const PrintArguments& arguments, const Write& write) {
    catch_interrupts();
    ProgressLine line("printing " + arguments.out);
    PrintOptions options = arguments.print;
    options.name = title_of(arguments);
    options.command = command_line();
    options.progress = [&line](int done, int total) {
        line.update(done, total);
        return !interrupted();
    };
    write(options);
}

void print_test_page(const PrintArguments& arguments, const Paper& paper) {
    TestPageOptions options;
    options.code = arguments.pattern.pattern().code;
    options.paper = paper;
    options.margin_mm = std::max(options.margin_mm, arguments.margin_mm.value_or(0));
    const PrintPage page = make_test_page(options);
    const DocumentOutput output(arguments.out, arguments.ending);
    with_progress(arguments, [&](const PrintOptions& print_options) {
        write_page(page, output.path(), print_options);
    });
    output.finish();
    fmt::print(output.report_stream(),
               "{}: test page {:g} x {:g} mm, {} patches; print it, scan it, then run: dotpose "
               "check-print SCAN\n",
               printable(arguments.out), page.width_mm, page.height_mm, page.sheets.size());
}

void require_apart(const PrintArguments& arguments) {
    RunFiles files;
    files.updates("--sheets", arguments.entries.path(), Content::json);
    files.writes("-o", arguments.out, Content::own);
}

void run(const PrintArguments& arguments) {
    require_apart(arguments);
    SheetOptions options = arguments.sheet;
    options.paper = paper_by_name(arguments.paper);
    if (arguments.landscape) options.paper = landscape(options.paper);
    const PrintFormat format = format_of(arguments);
    if (arguments.test_page) return print_test_page(arguments, options.paper);
    options.pattern = arguments.pattern.pattern();
    options.margin_mm = arguments.margin_mm.value_or(default_margin_mm(format, options.paper));
    std::vector<Sheet> sheets = make_sheets(options, arguments.pages);
    const auto page = [&sheets](std::size_t i) {
        return SheetEntryArguments::Page{static_cast<int>(i + 1), sheets.size() == 1};
    };
    const SheetPrint print = print_of(arguments);
    std::optional<SheetReservation> reservation;
    if (arguments.entries.given()) {
        catch_interrupts();  // must precede `require_writable`, which creates a file
        if (arguments.out != kStandardOutput) require_writable(system::path_of(arguments.out));
        const auto enter_all = [&](SheetFile& file) {
            for (std::size_t i = 0; i < sheets.size(); ++i)
                sheets[i] = arguments.entries.enter(file, sheets[i], page(i), print);
        };
        arguments.entries.reserve(enter_all, reservation);
    }
    const DocumentOutput output(arguments.out, arguments.ending);
    with_progress(arguments, [&](PrintOptions print_options) {
        if (reservation) {
            for (const Sheet& sheet : sheets)
                print_options.page_commands.push_back(
                    SheetEntryArguments::with_origin(print.command, sheet.origin));
        }
        write_sheets(sheets, output.path(), print_options);
    });
    output.finish();
    if (reservation) arguments.entries.confirm(*reservation, arguments.out);
    const std::string resolution =
        has_resolution(format) ? fmt::format(", {:g} dpi", arguments.print.dpi) : "";
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const std::string number =
            sheets.size() > 1 ? fmt::format("{}/{}, ", i + 1, sheets.size()) : "";
        fmt::print(output.report_stream(), "{}: {}{}{}{}\n", printable(arguments.out), number,
                   region_text(sheets[i]), resolution,
                   printable(arguments.entries.summary(page(i))));
    }
}

}  // namespace

void add_print(Command& app, int& /*exit_code*/) {
    const auto arguments = std::make_shared<PrintArguments>();
    Command* command = app.add_subcommand("print", "Make a sheet of dots to print");
    command->footer(kPrintExamples);
    command
        ->add_option("-o,--out", arguments->out,
                     "File to write: .pdf, .svg, .png, .tif or .txt, or - for standard output")
        ->type_name("FILE|-")
        ->required();
    command
        ->add_option_function<std::string>(
            "--format", [arguments](const std::string& name) { arguments->ending = '.' + name; },
            "Format of the file: " + alternatives(kFormats))
        ->type_name("NAME")
        ->default_str("by the ending of its name")
        ->check(one_of(kFormats));
    command
        ->add_option("--paper", arguments->paper,
                     "A0 to A6, Letter, Legal, Tabloid or WIDTHxHEIGHT in mm")
        ->type_name("SIZE")
        ->capture_default_str();
    command->add_flag("--landscape", arguments->landscape,
                      "Landscape: the longer side is horizontal");
    command->add_option("--margin", arguments->margin_mm, "Margin without dots on all sides")
        ->type_name("MM")
        ->default_str("5, in a .pdf 10 on pages over 60 mm");
    command
        ->add_option("--pages", arguments->pages,
                     "Number of pages of a .pdf, each with its own cells")
        ->type_name("N")
        ->capture_default_str();
    arguments->pattern.add_to(*command);
    add_cell_option(*command, "--origin", arguments->sheet.origin,
                    "Cell of the code plane at the top left");
    command->add_option("--dpi", arguments->print.dpi, "Native resolution of the printer")
        ->type_name("N")
        ->capture_default_str();
    add_drawing_option(*command, arguments->print.drawing);
    command->add_flag_callback(
        "--no-labels", [arguments] { arguments->print.labels = false; },
        "No text and rulers in the margins of a .pdf");
    arguments->entries.add_to(*command);
    Option* test_page = command->add_flag("--test-page", arguments->test_page,
                                          "Patches with several dot sizes and spacings, to find "
                                          "the best ones for a printer with check-print");
    for (const char* own :
         {"--spacing", "--dot", "--displacement", "--origin", "--section", "--pages", "--sheets"}) {
        test_page->excludes(command->get_option(own));
    }
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
