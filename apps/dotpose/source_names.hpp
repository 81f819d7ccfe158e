/// Names of the frame sources of a command.
#pragma once

#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace dotpose::cli {

/// Returns names one by one. The names of the command line and of a list file are known immediately
/// and come first. The names from a pipe follow as they arrive.
class SourceNames {
  public:
    /// `list` is a file with one name per line. "-" means standard input, and an empty string means
    /// no list. Throws Error if the list cannot be read or contains a line that is too long.
    SourceNames(std::vector<std::string> names, const std::string& list);

    const std::vector<std::string>& known() const { return known_; }

    /// Returns true if a pipe may still deliver names.
    bool has_pipe() const { return is_pipe_; }

    /// Returns the next name. Returns none after the last name, and in all calls after an error.
    /// Throws Error like the constructor.
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
