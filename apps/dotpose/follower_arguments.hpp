/// Options shared by all commands that locate images: code, spacing, sheets, camera, effort.
#pragma once

#include <string>

#include "command_line.hpp"
#include "common.hpp"
#include "dotpose/tools/follower.hpp"
#include "run_files.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct FollowerArguments {
    std::string sheets;  ///< path of the sheet file, or empty for none
    CameraArgument camera;
    std::string print_map;  ///< path of the print map, or empty for none
    bool is_inverted = false;
    FollowerOptions options;  ///< without the contents of the sheet file and camera file

    /// Adapts the camera file to the frames of `sources` (SourceArguments::fit_to). With a camera
    /// file, --reference is given as a pixel of the whole frame, so it is also adapted if --roi
    /// selects a region.
    void fit_to(SourceArguments& sources);

    /// Registers the input files.
    void add_files(RunFiles& files) const;

    /// Reads the sheet file and the print map. Throws Error if a file cannot be read, if it
    /// contains no sheets, or if the map belongs to other sheets.
    FollowerOptions read() const;
};

/// Adds the options. `sheets_help` describes how the command uses the sheet file.
void add_follower_options(Command& command, FollowerArguments& arguments,
                          const std::string& sheets_help);

/// Inverts the grey levels, so white dots on black become dark dots on white.
void invert(GreyImage& image);

}  // namespace dotpose::cli
