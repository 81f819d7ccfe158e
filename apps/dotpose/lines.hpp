/// Lines of output.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "dotpose/tools/error.hpp"

namespace dotpose::cli {

/// Nobody reads an output any more, as after `| head`.
struct ReaderLeft : Error {
    using Error::Error;
};

/// Throws Error, or ReaderLeft where that is the reason: an output could not be written, and errno
/// was this then.
[[noreturn]] void throw_unwritable(const std::string& output, int error_number);

/// Standard output or a file; every line leaves at once, so that stopping the tool loses none.
class Lines {
  public:
    /// An empty path is standard output. Throws Error if the file cannot be created.
    explicit Lines(const std::string& path);

    /// Throws Error if the line cannot be written: ReaderLeft where SIGPIPE is ignored.
    void write(const std::string& line);

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace dotpose::cli
