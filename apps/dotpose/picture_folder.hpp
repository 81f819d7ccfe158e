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

/// Returns true if a path is the name of a picture, NAME.svg, and not of a folder.
bool is_picture_name(const std::filesystem::path& path);

class PictureFolder {
  public:
    /// Creates the folder, unless `path` is the name of a picture. The parent folder must exist.
    /// `files` contains the files of the run, which no picture may overwrite. Throws Error if the
    /// folder cannot be created.
    PictureFolder(std::filesystem::path path, const RunFiles& files);

    /// Writes a picture. In a folder, its name is STEM.svg, where STEM is the name of the image
    /// without its file extension. For frame 17 of the video drive.mp4, which has the name
    /// drive.mp4#17, STEM is drive-17. If an earlier image had the same stem, the name is
    /// STEM-2.svg, and so on. The title in the options is replaced by the name of the image. Throws
    /// Error if the picture cannot be written.
    void add(const std::string& image_name, ImageView image, const Trace& trace,
             DrawOptions options);

  private:
    std::filesystem::path path_in_folder(const std::string& image_name);

    std::filesystem::path path_;
    const RunFiles& files_;
    std::set<std::string> used_;
};

}  // namespace dotpose::cli
