/// The folder of `--draw`, which gets one picture per image.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"
#include "run_files.hpp"

namespace dotpose::cli {

class PictureFolder {
  public:
    /// Creates the folder, whose parent must exist. Throws Error if that fails. `files` checks that
    /// no picture overwrites a file of the same run.
    PictureFolder(std::filesystem::path folder, const RunFiles& files);

    /// Writes STEM.svg, where STEM is the name of the image without its ending, or drive-17 for the
    /// frame drive.mp4#17; STEM-2.svg and so on if an earlier image had the same stem. Spacing and
    /// sheet are those of DrawOptions. Throws Error if it cannot be written.
    void add(const std::string& image_name, ImageView image, const Trace& trace, double spacing_mm,
             const std::string& sheet);

  private:
    std::filesystem::path folder_;
    const RunFiles& files_;
    std::set<std::string> used_;
};

}  // namespace dotpose::cli
