/// Output options with the same names and values in all commands: --format, --units, --draw and -o.
/// "-" as the value of -o means standard output.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "command_line.hpp"
#include "fields.hpp"
#include "lines.hpp"
#include "pose_fields.hpp"

namespace dotpose::cli {

/// Options for commands that write one line per frame or packet.
struct LineArguments {
    std::string out;  ///< path of the output file, or empty or "-" for standard output
    RecordFormat format = RecordFormat::json;
    Units units = Units::mm;
};

/// Adds --format json|csv and -o. If `has_text` is true, --format also accepts `text`. The default
/// format is `csv` if the file name given to -o ends in .csv, and `json` otherwise.
void add_format_options(Command& command, LineArguments& arguments, bool has_text = false);

/// Adds the options of `add_format_options`, and --units mm|ros.
void add_line_options(Command& command, LineArguments& arguments, bool has_text = false);

/// Options for commands that write a single report.
struct ReportArguments {
    std::string out;  ///< path of the output file, or empty or "-" for standard output
    bool as_json = false;
};

/// Adds --format text|json, and -o with the help text `out_help`. The default format is json if the
/// file name given to -o ends in .json, and text otherwise.
void add_report_options(Command& command, ReportArguments& arguments,
                        const std::string& out_help = "File to write instead of standard output");

/// Writes the report to the file given to -o or to standard output. Text written to a terminal is
/// coloured. Throws Error on failure.
void write_report(const ReportArguments& arguments, const std::string& report);

/// Adds --draw FILE, the path of an additional picture.
Option* add_draw_option(Command& command, std::string& path, const std::string& help);

/// A document that the library can only write to a named file. For standard output, the library
/// writes a temporary file, which `finish` then copies to standard output.
class DocumentOutput {
  public:
    /// `out` is the value of -o. `ending` is the file extension of the format, such as ".pdf".
    /// Throws Error if the temporary folder cannot be created.
    DocumentOutput(const std::string& out, const std::string& ending);

    /// Removes the temporary folder.
    ~DocumentOutput();
    DocumentOutput(const DocumentOutput&) = delete;
    DocumentOutput& operator=(const DocumentOutput&) = delete;

    /// Returns the path to which the library must write the document.
    const std::filesystem::path& path() const { return path_; }

    /// Copies the document to standard output if `out` is "-". Throws Error on failure.
    void finish() const;

    /// Returns the stream for reports: standard error if the document goes to standard output, and
    /// standard output otherwise.
    std::FILE* report_stream() const { return folder_.empty() ? stdout : stderr; }

  private:
    std::filesystem::path path_;
    std::filesystem::path folder_;  ///< temporary folder, or empty if none is needed
};

}  // namespace dotpose::cli
