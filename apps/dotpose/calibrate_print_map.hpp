/// Makes a print map, for `dotpose calibrate --print-map`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/camera.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct PrintMapArguments {
    SourceArguments sources;
    std::string sheets;  ///< path of the sheet file
    std::string camera_path;
    std::optional<Camera> camera;
    std::string out;      ///< path of the map, which is updated if it exists
    std::string picture;  ///< path of the picture of the map (SVG), or empty
};

/// Reads all frames, and writes or updates the map. After Ctrl-C, no more frames are read, and the
/// map is made from the frames read so far. Prints a report.
void make_print_map(const PrintMapArguments& arguments);

}  // namespace dotpose::cli
