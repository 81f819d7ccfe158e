/// Writes the frames rendered by `dotpose simulate` to a folder of images or to a video.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "dotpose/tools/grey_image.hpp"

namespace dotpose::cli {

/// Header line of the file of true poses.
inline constexpr const char* kTruthHeader =
    "file,x_mm,y_mm,theta_deg,x_grid,y_grid,section_u,section_v,code,spacing_mm,px_per_spacing,"
    "preset,seed\n";

class SimulateOutput {
  public:
    virtual ~SimulateOutput() = default;

    /// Returns the path of the file of true poses.
    virtual std::filesystem::path truth_path() const = 0;
    /// Returns the name of a frame, as used in the file of true poses.
    virtual std::string name(int index) const = 0;
    /// Writes the next frame. Throws Error on failure.
    virtual void write(int index, const GreyImage& image) = 0;
    /// Finishes the output. Throws Error on failure.
    virtual void finish() = 0;
};

bool is_video_name(const std::string& out);

/// Opens `out`, a video or a folder, for writing. Creates the folder if it does not exist, and
/// otherwise removes the frames of earlier runs from it. Throws Error if the folder contains frames
/// that `dotpose simulate` did not create.
std::unique_ptr<SimulateOutput> open_simulate_output(const std::string& out, double fps);

}  // namespace dotpose::cli
