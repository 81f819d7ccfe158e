/// Saves frames as images, for `dotpose calibrate` or for later analysis.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/image_file.hpp"
#include "new_places.hpp"

namespace dotpose::cli {

struct SaveOptions {
    std::string folder;  ///< folder for the saved frames, or empty to save none
    /// If positive, every `every`-th frame is saved. If 0, each frame that shows a new place
    /// (NewPlaces) is saved.
    std::int64_t every = 0;
    ImageEncoding format = ImageEncoding::png;
};

class FrameSaver {
  public:
    /// Creates the folder, whose parent must exist. Throws Error if the folder cannot be created.
    explicit FrameSaver(SaveOptions options);

    /// Saves the frame if SaveOptions::every selects it. Files are named frame_000000, frame_000001
    /// and so on, with the extension of the format. Numbering continues after the highest number in
    /// the folder, and existing files are never overwritten. Throws Error if the image cannot be
    /// written.
    void take(ImageView image, const Fix& fix);

    std::int64_t saved() const { return saved_; }

  private:
    bool is_wanted(ImageView image, const Fix& fix);

    SaveOptions options_;
    NewPlaces places_;
    std::int64_t frames_ = 0;
    std::int64_t saved_ = 0;
    std::int64_t next_number_ = 0;
};

}  // namespace dotpose::cli
