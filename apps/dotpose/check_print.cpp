#include "dotpose/check_print.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "check_print_report.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/image_file.hpp"
#include "progress.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose check-print scan.png\n"
    "  dotpose check-print scan.jpg --dpi 600 --spacing 0.508 --dot 0.085 -o map.svg\n"
    "  dotpose print --test-page -o test.svg    (print and scan it, then)\n"
    "  dotpose check-print test-scan.png\n\n"
    "Scan the whole page at 600 dpi, without sharpening. Exit status 1 if there is no pattern.\n";

struct CheckPrintArguments {
    std::string scan;
    std::string out;
    std::optional<double> dpi;
    bool as_json = false;
    PatternArguments pattern;
};

void require_svg(const std::string& path) {
    const bool is_svg = path.size() > 4 && path.substr(path.size() - 4) == ".svg";
    if (is_svg) return;
    throw BadArgument(fmt::format("'{}': the name of the map must end in .svg", path));
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
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace dotpose::cli
