/// The folder of `--draw`: one picture per image.
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
    /// Creates the folder, in one that exists. Throws Error. The pictures are outputs of the run
    /// that has `files`.
    PictureFolder(std::filesystem::path folder, const RunFiles& files);

    /// Writes STEM.svg after the image's name, or STEM-2.svg and so on if an earlier image had the
    /// same stem. Throws Error.
    void add(const std::string& image_name, ImageView image, const Trace& trace, double spacing_mm);

  private:
    std::filesystem::path folder_;
    const RunFiles& files_;
    std::set<std::string> used_;
};

}  // namespace dotpose::cli
