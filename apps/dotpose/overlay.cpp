#include "dotpose/tools/overlay.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/write_file.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "sheet_entries.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

struct OverlayArguments {
    std::string in;
    std::string out;
    OverlayOptions options;
    PatternArguments pattern;
    SheetEntryArguments entries;
};

constexpr const char* kOverlayExamples =
    "Examples:\n"
    "  dotpose overlay form.pdf -o form-dots.pdf --origin 5000,0\n"
    "  dotpose overlay form.pdf -o form-dots.pdf --sheets sheets.json --name form\n"
    "  dotpose overlay form.pdf -o form-dots.pdf --pages 1-3 --under --cmy-black\n"
    "  dotpose overlay form.pdf -o class.pdf --copies 30 --sheets sheets.json --name form\n"
    "  dotpose overlay card.pdf -o cards.pdf --copies 30 --paper A4\n\n"
    "Each page gets a region of its own, with --sheets one that no other sheet of the file has;\n"
    "the sheet of page 3 then is called form-3. The pages of further copies count on: of 30 "
    "copies\n"
    "of two pages, the last one is form-60. With --paper, small pages become cards: as many as "
    "fit\n"
    "are printed on one page, with marks to cut them apart; each card is a separate sheet.\n\n"
    "Black ink hides dots from infrared cameras: --cmy-black prints the document's black from\n"
    "cyan, magenta and yellow, which these cameras do not see.\n";

void require_apart(const OverlayArguments& arguments) {
    RunFiles files;
    files.reads("", arguments.in);
    files.updates("--sheets", arguments.entries.path(), Content::json);
    files.writes("-o", arguments.out, Content::own);
}

/// Returns the print settings to store in a page's entry in the sheet file. The stored command line
/// omits the password.
SheetPrint print_of(const OverlayArguments& arguments, int document_page, int pages) {
    std::set<std::string> left_out = SheetEntryArguments::options_of_entering();
    left_out.insert({"--password", "--copies", "--paper"});
    SheetPrint print;
    print.title = system::path_of(arguments.out).stem().string();
    print.pages = pages;
    print.dpi = arguments.options.dpi;
    print.dots = drawing_name(arguments.options.drawing);
    print.has_labels = false;
    print.command = fmt::format("{} --pages {}", command_line(left_out), document_page);
    print.document = arguments.in;
    return print;
}

void run(OverlayArguments& arguments) {
    require_apart(arguments);
    OverlayOptions options = arguments.options;
    options.pattern = arguments.pattern.pattern();
    catch_interrupts();
    std::optional<SheetReservation> reservation;
    if (arguments.entries.given()) {
        if (arguments.out != kStandardOutput) require_writable(system::path_of(arguments.out));
        options.place = [&](std::span<OverlaidPage> pages) {
            const auto enter_all = [&](SheetFile& file) {
                for (auto& [number, sheet, document_page] : pages)
                    sheet = arguments.entries.enter(
                        file, sheet, {number, pages.size() == 1},
                        print_of(arguments, document_page, static_cast<int>(pages.size())));
            };
            arguments.entries.reserve(enter_all, reservation);
        };
    }
    const DocumentOutput output(arguments.out, ".pdf");
    OverlayReport report;
    {
        ProgressLine line("writing " + arguments.out);
        options.progress = [&line](int rows_done, int rows) {
            line.update(rows_done, rows);
            return !interrupted();
        };
        report = overlay_pdf(system::path_of(arguments.in), output.path(), options);
    }
    output.finish();
    if (reservation) arguments.entries.confirm(*reservation, arguments.out);
    if (report.card_pages > 0) {
        fmt::print(output.report_stream(), "{}: {} cards on {} pages\n", printable(arguments.out),
                   report.pages.size(), report.card_pages);
    }
    for (const auto& [number, sheet, document_page] : report.pages)
        fmt::print(output.report_stream(), "{} {}: {}{}\n", printable(arguments.out), number,
                   region_text(sheet),
                   printable(arguments.entries.summary({number, report.pages.size() == 1})));
    for (const std::string& warning : report.warnings)
        notify("warning: " + warning);
}

void add_ink_options(Command& command, OverlayOptions& options) {
    command.add_flag("--under", options.under, "Dots below the document instead of above");
    command.add_flag("--cmy-black", options.black_to_cmy,
                     "Print the document's black without black ink");
    command
        .add_option("--lighten", options.lighten,
                    "Fraction of the ink of the document to remove, 0 to below 1")
        ->type_name("PART")
        ->capture_default_str();
}

}  // namespace

void add_overlay(Command& app, int& /*exit_code*/) {
    const auto arguments = std::make_shared<OverlayArguments>();
    OverlayOptions& options = arguments->options;
    Command* command = app.add_subcommand("overlay", "Lay dots over the pages of a PDF");
    command->footer(kOverlayExamples);
    command->add_option("pdf", arguments->in, "Document to lay the dots over")
        ->type_name("FILE")
        ->required();
    command->add_option("-o,--out", arguments->out, "PDF to write, or - for standard output")
        ->type_name("FILE|-")
        ->required();
    command
        ->add_option("--pages", options.pages,
                     "Pages to lay dots over, such as 1-3,7; z is the last")
        ->type_name("RANGE")
        ->default_str("all");
    command
        ->add_option("--copies", options.copies, "Copies of the document, each with its own cells")
        ->type_name("N")
        ->capture_default_str()
        ->check(Range(1, kMaxPages));
    command
        ->add_option_function<std::string>(
            "--paper",
            [&options](const std::string& name) { options.card_paper = paper_by_name(name); },
            "Put pages side by side on paper of this size, as cards to cut apart: A4, Letter, "
            "WIDTHxHEIGHT in mm")
        ->type_name("SIZE");
    command->add_option("--password", options.password, "Password of an encrypted document")
        ->type_name("TEXT");
    add_ink_options(*command, options);
    command->add_option("--margin", options.margin_mm, "Margin without dots on all sides")
        ->type_name("MM")
        ->capture_default_str();
    arguments->pattern.add_to(*command);
    add_cell_option(*command, "--origin", options.origin,
                    "Cell of the code plane at the top left of the first page");
    arguments->entries.add_to(*command);
    command
        ->add_option("--max-content", options.max_content_mb,
                     "Maximum size of the unpacked content of a page")
        ->type_name("MB")
        ->capture_default_str()
        ->check(Range(1, 1'000'000));
    command->add_option("--dpi", options.dpi, "Native resolution of the printer")
        ->type_name("N")
        ->capture_default_str();
    add_drawing_option(*command, options.drawing);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
