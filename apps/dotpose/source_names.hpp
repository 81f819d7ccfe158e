/// Names of the frame sources given to a command.
#pragma once

#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace dotpose::cli {

/// Iterates over the names of the sources: first the names from the command line and from a list
/// file, which are known immediately, then the names from a pipe as they arrive.
class SourceNames {
  public:
    /// `list` is the path of a file with one name per line, "-" for standard input, or empty for no
    /// list. Throws Error if the list cannot be read or contains a line that is too long.
    SourceNames(std::vector<std::string> names, const std::string& list);

    const std::vector<std::string>& known() const { return known_; }

    /// Returns true if the list is standard input or a pipe, so its names are not known in advance.
    bool has_pipe() const { return is_pipe_; }

    /// Returns the next name, or none after the last name. Throws Error if the list cannot be read
    /// or contains a line that is too long. After an error, all further calls return none.
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
