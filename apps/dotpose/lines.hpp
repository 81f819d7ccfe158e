/// Writes lines of output.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "dotpose/files/error.hpp"

namespace dotpose::cli {

/// Value of -o for standard output.
inline constexpr const char* kStandardOutput = "-";

/// Returns true if `out`, the value of -o, names standard output. `out` is empty if -o is not
/// given.
inline bool is_standard_output(const std::string& out) {
    return out.empty() || out == kStandardOutput;
}

/// Thrown when writing to an output whose reader, such as `head`, has ended.
struct ReaderLeft : Error {
    using Error::Error;
};

/// Throws ReaderLeft if the reader closed the output, otherwise Error because the output cannot be
/// written. `error_number` is the errno of the failure.
[[noreturn]] void throw_unwritable(const std::string& output, int error_number);

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

/// Creates or truncates a file. Throws Error on failure.
File create_file(const std::string& path);

/// Writes lines to standard output or a file. Flushes each line, so no line is lost if the tool is
/// stopped.
class Lines {
  public:
    /// An empty path or "-" means standard output. Throws Error if the file cannot be created.
    explicit Lines(const std::string& path);

    /// Writes a line. Throws ReaderLeft if the reader closed the output and SIGPIPE is ignored.
    /// Throws Error if the line cannot be written for any other reason.
    void write(const std::string& line);

  private:
    std::string path_;
    File file_;  ///< null for standard output
};

}  // namespace dotpose::cli
