/// The names of the images that a command reads.
#pragma once

#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace dotpose::cli {

/// All names in turn: those on the command line and of a list in a file, which are known from the
/// start, then those of a list in a pipe, read as they come.
class ImageNames {
  public:
    /// `list`: a file with a name a line, "-" for standard input; empty: none. Throws Error where
    /// the list cannot be read, or a line is too long.
    ImageNames(std::vector<std::string> images, const std::string& list);

    const std::vector<std::string>& known() const { return known_; }

    /// None after the last one. Throws Error likewise.
    std::optional<std::string> next();

  private:
    std::optional<std::string> next_of_list();

    std::vector<std::string> known_;
    std::string list_name_;
    std::size_t next_known_ = 0;
    std::ifstream file_;
    std::istream* list_ = nullptr;
};

}  // namespace dotpose::cli
