#include "output_arguments.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <system_error>
#include <utility>

#include "choices.hpp"
#include "dotpose/files/error.hpp"
#include "print/lower_case.hpp"
#include "system/files.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

namespace fs = std::filesystem;

/// Adds the -o option. If the file name after -o ends with `ending` and the `format` option is not
/// given, calls `choose` to select the format. `format` must be added before -o, because it must
/// also be parsed before -o.
void add_out_option(Command& command, std::string& out, const std::string& help,
                    const Option* format, const char* ending, const std::function<void()>& choose) {
    command
        .add_option_function<std::string>(
            "-o,--out",
            [=, &out](const std::string& path) {
                out = path;
                const bool is_named = print::lower_case(path).ends_with(ending);
                if (is_named && format->count() == 0) choose();
            },
            help)
        ->type_name("FILE|-");
}

}  // namespace

void add_format_options(Command& command, LineArguments& arguments, bool has_text) {
    const Option* format =
        command
            .add_option_function<std::string>(
                "--format",
                [&arguments](const std::string& name) {
                    arguments.format = name == "csv"    ? RecordFormat::csv
                                       : name == "text" ? RecordFormat::text
                                                        : RecordFormat::json;
                },
                has_text ? "json (an object per line), csv, or text (a line to read)"
                         : "json (an object per line) or csv")
            ->type_name("NAME")
            ->default_str("json, or by the name of the output")
            ->check(has_text ? one_of({"json", "csv", "text"}) : one_of({"json", "csv"}));
    add_out_option(command, arguments.out, "File to write instead of standard output", format,
                   ".csv", [&arguments] { arguments.format = RecordFormat::csv; });
}

void add_line_options(Command& command, LineArguments& arguments, bool has_text) {
    add_format_options(command, arguments, has_text);
    command
        .add_option_function<std::string>(
            "--units",
            [&arguments](const std::string& name) {
                arguments.units = name == "ros" ? Units::ros : Units::mm;
            },
            "Units of poses: mm (and degrees, y down) or ros (metres and radians, y up: REP 103)")
        ->type_name("NAME")
        ->default_str("mm")
        ->check(one_of({"mm", "ros"}));
}

void add_report_options(Command& command, ReportArguments& arguments, const std::string& out_help) {
    const Option* format =
        command
            .add_option_function<std::string>(
                "--format",
                [&arguments](const std::string& name) { arguments.as_json = name == "json"; },
                "Format of the report: text or json (one object)")
            ->type_name("NAME")
            ->default_str("text, or by the name of the output")
            ->check(one_of({"text", "json"}));
    add_out_option(command, arguments.out, out_help, format, ".json",
                   [&arguments] { arguments.as_json = true; });
}

void write_report(const ReportArguments& arguments, const std::string& report) {
    const bool is_out = is_standard_output(arguments.out);
    const bool is_plain = arguments.as_json || !is_out;
    Lines(arguments.out).write(is_plain ? report : for_standard_output(report));
}

Option* add_draw_option(Command& command, std::string& path, const std::string& help) {
    return command.add_option("--draw", path, help)->type_name("FILE");
}

DocumentOutput::DocumentOutput(const std::string& out, const std::string& ending)
    : path_(system::path_of(out)) {
    if (out != kStandardOutput) return;
    try {
        folder_ = system::create_temporary_folder();
    } catch (const fs::filesystem_error& error) {
        throw Error("cannot create a temporary folder: " + error.code().message());
    }
    path_ = folder_ / system::path_of("document" + ending);
}

DocumentOutput::~DocumentOutput() {
    std::error_code failed;
    if (!folder_.empty()) fs::remove_all(folder_, failed);
}

void DocumentOutput::finish() const {
    if (folder_.empty()) return;
    std::ifstream file(path_, std::ios::binary);
    Lines standard_output(kStandardOutput);
    std::string part(1 << 16, '\0');
    while (file) {
        file.read(part.data(), static_cast<std::streamsize>(part.size()));
        standard_output.write(part.substr(0, static_cast<std::size_t>(file.gcount())));
    }
    if (!file.eof()) throw Error("cannot read " + path_.string());
}

}  // namespace dotpose::cli
