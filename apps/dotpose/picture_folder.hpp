/// Pictures written by `--draw`: a folder with one picture per image, or NAME.svg for one image.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "dotpose/image.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/trace.hpp"
#include "run_files.hpp"

namespace dotpose::cli {

/// Returns true if a path is the name of a picture, NAME.svg, rather than a folder.
bool is_picture_name(const std::filesystem::path& path);

class PictureFolder {
  public:
    /// Creates the folder, unless `path` is the name of a picture. The parent folder must exist.
    /// Throws Error if the folder cannot be created. `files` is used to check that no picture
    /// overwrites a file of the same run.
    PictureFolder(std::filesystem::path path, const RunFiles& files);

    /// Writes a picture. In a folder, the name of the picture is STEM.svg. STEM is the name of the
    /// image without its file extension, or drive-17 for the frame drive.mp4#17. If an earlier
    /// image had the same stem, the name is STEM-2.svg and so on. The name of the image replaces
    /// the title in the options. Throws Error if the picture cannot be written.
    void add(const std::string& image_name, ImageView image, const Trace& trace,
             DrawOptions options);

  private:
    std::filesystem::path path_in_folder(const std::string& image_name);

    std::filesystem::path path_;
    const RunFiles& files_;
    std::set<std::string> used_;
};

}  // namespace dotpose::cli
