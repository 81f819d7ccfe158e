/// Writes lines of output.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "dotpose/files/error.hpp"

namespace dotpose::cli {

/// The value of -o for standard output.
inline constexpr const char* kStandardOutput = "-";

/// Whether `out`, given for -o, is standard output: "-", or empty for no -o at all.
inline bool is_standard_output(const std::string& out) {
    return out.empty() || out == kStandardOutput;
}

/// The reader of an output has closed it, as `head` does.
struct ReaderLeft : Error {
    using Error::Error;
};

/// Throws Error for an output that could not be written, with the reason `error_number`, a value of
/// errno; ReaderLeft if the reader has closed the output.
[[noreturn]] void throw_unwritable(const std::string& output, int error_number);

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
/// A file of the C library, which is closed at the end.
using File = std::unique_ptr<std::FILE, FileCloser>;

/// Creates a file, or empties it. Throws Error if that is not possible.
File create_file(const std::string& path);

/// Standard output or a file. Every line is flushed, so that none is lost if the tool is stopped.
class Lines {
  public:
    /// An empty path or "-" is standard output. Throws Error if the file cannot be created.
    explicit Lines(const std::string& path);

    /// Throws Error if the line cannot be written: ReaderLeft if the reader has closed the output
    /// and SIGPIPE is ignored.
    void write(const std::string& line);

  private:
    std::string path_;
    File file_;  ///< none for standard output
};

}  // namespace dotpose::cli
