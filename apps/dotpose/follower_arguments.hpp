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
    /// Options without `camera`, `sheets` and `print_map`, which `read` adds.
    FollowerOptions options;

    /// Adapts `camera` to the frames from `sources` (see SourceArguments::fit_to). If --roi is
    /// given and the camera file describes full frames, also converts --reference from the full
    /// frame to the region.
    void fit_to(SourceArguments& sources);

    /// Registers all files named by these options as inputs.
    void add_files(RunFiles& files) const;

    /// Returns `options` with the camera, the sheets and the print map. Reads the sheet file and
    /// the print map. Throws Error in these cases:
    /// - A file cannot be read.
    /// - The sheet file contains no sheets.
    /// - The print map does not belong to the sheets.
    /// - Poses in space are required, but the camera file contains no focal length.
    ///
    /// Throws BadArgument if poses in space are required, but no camera file is given.
    FollowerOptions read() const;
};

/// Adds the options. `sheets_help` describes what the command uses the sheet file for.
void add_follower_options(Command& command, FollowerArguments& arguments,
                          const std::string& sheets_help);

/// Inverts the grey levels: white dots on black become dark dots on white.
void invert(GreyImage& image);

}  // namespace dotpose::cli
