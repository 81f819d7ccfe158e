/// Helpers for the print tests: temporary directories, and readers that share no code with the
/// writers under test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dotpose::print_test {

/// A temporary directory that is initially empty. The destructor removes it.
class TemporaryDirectory {
  public:
    TemporaryDirectory();
    ~TemporaryDirectory();
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Returns the sorted names of all files in the directory, including hidden files.
    std::vector<std::string> names() const;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& content);

/// A page with 1 bit per pixel, as read from its file.
struct Bitmap {
    int width_px = 0;
    int height_px = 0;
    int bits_per_pixel = 0;
    double x_dpi = 0;
    double y_dpi = 0;
    std::vector<char> ink;  ///< row by row (1 is black, 0 is white)

    bool at(int u, int v) const {
        return ink.at(static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) +
                      static_cast<std::size_t>(u)) != 0;
    }
    int count_ink() const;
};

Bitmap read_png(const std::filesystem::path& path);
Bitmap read_tiff(const std::filesystem::path& path);

}  // namespace dotpose::print_test
