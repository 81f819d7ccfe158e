/// Writes output lines.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "dotpose/files/error.hpp"

namespace dotpose::cli {

/// Value of -o that means standard output.
inline constexpr const char* kStandardOutput = "-";

/// Returns true if `out` means standard output. `out` is the value of -o, or empty if -o is not
/// given.
inline bool is_standard_output(const std::string& out) {
    return out.empty() || out == kStandardOutput;
}

/// Thrown when the process that reads an output, such as `head`, has closed the output.
struct ReaderLeft : Error {
    using Error::Error;
};

/// Throws ReaderLeft if the reader closed the output, and Error otherwise. `error_number` is the
/// errno of the failed write.
[[noreturn]] void throw_unwritable(const std::string& output, int error_number);

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

/// Creates or truncates a file. Throws Error on failure.
File create_file(const std::string& path);

/// Writes lines to standard output or to a file. Flushes after each line, so no line is lost if the
/// tool is terminated.
class Lines {
  public:
    /// An empty path or "-" means standard output. Throws Error if the file cannot be created.
    explicit Lines(const std::string& path);

    /// Writes a line. Throws ReaderLeft if the reader closed the output and SIGPIPE is ignored.
    /// Throws Error on any other failure.
    void write(const std::string& line);

  private:
    std::string path_;
    File file_;  ///< null for standard output
};

}  // namespace dotpose::cli
