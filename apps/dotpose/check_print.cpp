#include "dotpose/check_print.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "check_print_report.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/image_file.hpp"
#include "dotpose/sheet_file.hpp"
#include "progress.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose check-print scan.png\n"
    "  dotpose check-print scan.jpg --dpi 600 --spacing 0.508 --dot 0.085 -o map.svg\n"
    "  dotpose check-print scan.png --fit --sheets sheets.json\n"
    "  dotpose print --test-page -o test.pdf    (print and scan it, then)\n"
    "  dotpose check-print test-scan.png\n\n"
    "Scan the whole page at 600 dpi, without sharpening. Exit status 1 if there is no pattern.\n";

struct CheckPrintArguments {
    std::string scan;
    std::string out;
    std::optional<double> dpi;
    bool as_json = false;
    bool fit = false;
    std::string sheets;
    PatternArguments pattern;
};

void require_svg(const std::string& path) {
    const bool is_svg = path.size() > 4 && path.substr(path.size() - 4) == ".svg";
    if (is_svg) return;
    throw BadArgument(fmt::format("'{}': the name of the map must end in .svg", path));
}

/// Part of the code plane that was seen on the scan.
Sheet seen(const PrintField& field) {
    Sheet sheet;
    sheet.pattern = field.pattern;
    sheet.origin = field.origin;
    sheet.columns = field.columns;
    sheet.rows = field.rows;
    return sheet;
}

/// Writes the scale of every field into the sheet that it belongs to; returns what it did.
std::string fit_sheets(const std::string& path, const PrintCheck& check) {
    SheetFile file(path);
    std::string done;
    for (const PrintField& field : check.fields) {
        if (!field.scale) continue;
        const std::vector<SheetEntry> entries = file.sheets();
        const auto found = std::find_if(
            entries.begin(), entries.end(),
            [&](const SheetEntry& entry) { return overlap(entry.sheet, seen(field)); });
        if (found == entries.end()) continue;
        SheetEntry entry = *found;
        // The scale was measured against the spacing that this command was told.
        const double ratio = field.pattern.spacing_mm / entry.sheet.pattern.spacing_mm;
        entry.print_scale_x = field.scale->scale_x * ratio;
        entry.print_scale_y = field.scale->scale_y * ratio;
        file.replace(entry);
        done += fmt::format("sheet '{}' of {}: print scale x {:.5f}, y {:.5f}\n", entry.name, path,
                            entry.print_scale_x, entry.print_scale_y);
    }
    if (done.empty()) {
        throw Error(fmt::format("{}: no sheet of it is on the scan with a known scale", path));
    }
    file.save();
    return done;
}

/// Returns the exit status.
int run(const CheckPrintArguments& arguments) {
    if (!arguments.out.empty()) require_svg(arguments.out);
    CheckPrintOptions options;
    options.pattern = arguments.pattern.pattern();
    options.resolution = arguments.dpi ? Resolution{*arguments.dpi, *arguments.dpi}
                                       : read_resolution(arguments.scan);
    const GreyImage scan = read_image(arguments.scan);
    catch_interrupts();
    PrintCheck check;
    {
        ProgressLine line("checking " + arguments.scan);
        options.progress = [&line](int done, int total) {
            line.update(done, total);
            return !interrupted();
        };
        check = check_print(scan.view(), options);
    }
    if (!arguments.out.empty() && !check.fields.empty()) {
        draw_distortion(arguments.out, scan.view(), check);
    }
    const CheckedScan checked{arguments.scan, scan.width_px, scan.height_px};
    const std::string report =
        arguments.as_json ? json_report(checked, check) : text_report(checked, check);
    std::fputs(report.c_str(), stdout);
    if (arguments.fit) std::fputs(fit_sheets(arguments.sheets, check).c_str(), stderr);
    return check.fields.empty() ? kExitFailed : 0;
}

}  // namespace

void add_check_print(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<CheckPrintArguments>();
    CLI::App* command =
        app.add_subcommand("check-print", "Judge a printed sheet by a scan or photo of it");
    command->footer(kExamples);
    command->add_option("scan", arguments->scan, "PNG, TIFF, JPEG, BMP or PGM file")
        ->type_name("SCAN")
        ->required();
    command->add_option("--dpi", arguments->dpi, "Resolution of the scan")
        ->type_name("N")
        ->default_str("as the file states")
        ->check(CLI::Range(1.0, 100'000.0));
    arguments->pattern.add_to(*command, PatternArguments::Use::expected);
    command
        ->add_option_function<std::string>(
            "--format",
            [arguments](const std::string& name) { arguments->as_json = name == "json"; },
            "text or json")
        ->type_name("NAME")
        ->default_str("text")
        ->check(CLI::IsMember({"text", "json"}));
    command->add_option("-o,--out", arguments->out, "Also draw a map of the distortion (.svg)")
        ->type_name("FILE");
    CLI::Option* fit = command->add_flag(
        "--fit", arguments->fit, "Write the scale found into the sheet file, for true millimetres");
    CLI::Option* sheets =
        add_sheets_option(*command, arguments->sheets, "Sheet file that the sheet is in");
    fit->needs(sheets);
    sheets->needs(fit);
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace dotpose::cli
