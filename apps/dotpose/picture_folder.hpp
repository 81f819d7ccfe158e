/// Pictures written by `--draw`: a folder with one picture per image, or a single picture NAME.svg.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "dotpose/image.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/trace.hpp"
#include "run_files.hpp"

namespace dotpose::cli {

/// Returns true if the path names a picture, NAME.svg, rather than a folder.
bool is_picture_name(const std::filesystem::path& path);

class PictureFolder {
  public:
    /// Creates the folder, unless `path` names a picture. The parent folder must exist. `files` are
    /// the files of the run, and pictures must not overwrite them. Throws Error if the folder
    /// cannot be created.
    PictureFolder(std::filesystem::path path, const RunFiles& files);

    /// Writes a picture, with the name of the image as its title. In a folder, the file name is
    /// STEM.svg, where STEM is the image name without its file extension. For frame 17 of the video
    /// drive.mp4, the image name is drive.mp4#17 and STEM is drive-17. If the file name is already
    /// taken, it becomes STEM-2.svg, and so on. Throws Error if the picture cannot be written.
    void add(const std::string& image_name, ImageView image, const Trace& trace,
             DrawOptions options);

  private:
    std::filesystem::path path_in_folder(const std::string& image_name);

    std::filesystem::path path_;
    const RunFiles& files_;
    std::set<std::string> used_;
};

}  // namespace dotpose::cli
