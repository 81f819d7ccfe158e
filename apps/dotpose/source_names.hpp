/// Names of the sources of frames that a command reads.
#pragma once

#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace dotpose::cli {

/// Returns all names one after the other: first those on the command line and in a list file, which
/// are known from the start, then those of a list in a pipe, which are read as they arrive.
class SourceNames {
  public:
    /// `list` is a file with one name per line, "-" for standard input, or empty for none. Throws
    /// Error if the list cannot be read or a line is too long.
    SourceNames(std::vector<std::string> names, const std::string& list);

    const std::vector<std::string>& known() const { return known_; }

    /// Whether names may follow that are not known yet.
    bool has_pipe() const { return is_pipe_; }

    /// Returns the next name, or none after the last one. Throws Error like the constructor; then
    /// there are no more names.
    std::optional<std::string> next();

  private:
    std::optional<std::string> next_of_list();

    std::vector<std::string> known_;
    std::string list_name_;
    std::size_t next_known_ = 0;
    bool is_pipe_ = false;
    std::ifstream file_;
    std::istream* list_ = nullptr;
};

}  // namespace dotpose::cli
