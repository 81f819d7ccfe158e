/// Names of the images that a command reads.
#pragma once

#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace dotpose::cli {

/// Returns all names one after the other: first those on the command line and in a list file, which
/// are known from the start, then those of a list in a pipe, which are read as they arrive.
class ImageNames {
  public:
    /// `list` is a file with one name per line, "-" for standard input, or empty for none. Throws
    /// Error if the list cannot be read or a line is too long.
    ImageNames(std::vector<std::string> images, const std::string& list);

    const std::vector<std::string>& known() const { return known_; }

    /// Returns the next name, or none after the last one. Throws Error like the constructor.
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
