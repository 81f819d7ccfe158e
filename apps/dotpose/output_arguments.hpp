/// The options of output, which have the same names and values in all commands: --format, --units,
/// --draw, and -o, where - is standard output.
#pragma once

#include <cstdio>
#include <string>

#include "command_line.hpp"
#include "fields.hpp"
#include "lines.hpp"
#include "pose_fields.hpp"

namespace dotpose::cli {

/// The options of commands that write a line for each frame or packet.
struct LineArguments {
    std::string out;  ///< file to write; empty or "-" for standard output
    RecordFormat format = RecordFormat::json;
    Units units = Units::mm;
};

/// Adds --format json|csv, --units mm|ros and -o; with `has_text` also --format text. The ending
/// .csv of -o chooses csv.
void add_line_options(Command& command, LineArguments& arguments, bool has_text = false);

/// The options of commands that write one report.
struct ReportArguments {
    std::string out;  ///< file to write; empty or "-" for standard output
    bool as_json = false;
};

/// Adds --format text|json, and -o with `out_help`. The ending .json of -o chooses json.
void add_report_options(Command& command, ReportArguments& arguments,
                        const std::string& out_help = "File to write instead of standard output");

/// Writes the report to the file of -o or to standard output, there in colour if it is text and
/// the terminal wants it. Throws Error.
void write_report(const ReportArguments& arguments, const std::string& report);

/// Adds --draw FILE, a picture to draw as well.
Option* add_draw_option(Command& command, std::string& path, const std::string& help);

/// Where a document that goes to a named file in the library is written: there, or if it is to go
/// to standard output, into a temporary file that is copied there at the end.
class DocumentOutput {
  public:
    /// `out` is what the user gave for -o, `ending` that of the format, such as ".pdf". Throws
    /// Error if no temporary file can be made.
    DocumentOutput(std::string out, const std::string& ending);

    /// Removes the temporary file.
    ~DocumentOutput();
    DocumentOutput(const DocumentOutput&) = delete;
    DocumentOutput& operator=(const DocumentOutput&) = delete;

    /// The file for the library to write.
    const std::string& path() const { return path_; }

    /// Copies the document to standard output if it is to go there. Throws Error.
    void finish() const;

    /// Where the command reports what it wrote: standard error if the document goes to standard
    /// output.
    std::FILE* report_stream() const { return folder_.empty() ? stdout : stderr; }

  private:
    std::string path_;
    std::string folder_;  ///< temporary folder; empty if there is none
};

}  // namespace dotpose::cli
