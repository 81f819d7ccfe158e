/// The pictures of `--draw`: a folder, which gets one picture per image, or NAME.svg for one image.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "dotpose/image.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/trace.hpp"
#include "run_files.hpp"

namespace dotpose::cli {

/// Whether a path is the name of a picture, NAME.svg, and not that of a folder.
bool is_picture_name(const std::filesystem::path& path);

class PictureFolder {
  public:
    /// Creates the folder, whose parent must exist, unless `path` is the name of a picture. Throws
    /// Error if that fails. `files` checks that no picture overwrites a file of the same run.
    PictureFolder(std::filesystem::path path, const RunFiles& files);

    /// Writes the picture, or in a folder STEM.svg, where STEM is the name of the image without its
    /// ending, or drive-17 for the frame drive.mp4#17; STEM-2.svg and so on if an earlier image had
    /// the same stem. The title of the options is replaced. Throws Error if it cannot be written.
    void add(const std::string& image_name, ImageView image, const Trace& trace,
             DrawOptions options);

  private:
    std::filesystem::path path_in_folder(const std::string& image_name);

    std::filesystem::path path_;
    const RunFiles& files_;
    std::set<std::string> used_;
};

}  // namespace dotpose::cli
