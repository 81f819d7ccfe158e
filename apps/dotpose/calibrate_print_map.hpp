/// Creates a print map for `dotpose calibrate --print-map`.
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
    std::string out;      ///< path of the map, which is updated if the file exists
    std::string picture;  ///< path of an SVG picture of the map, or empty for no picture
};

/// Reads all frames, creates or updates the map, and prints a report. After Ctrl-C, stops reading
/// and uses only the frames read so far.
void make_print_map(const PrintMapArguments& arguments);

}  // namespace dotpose::cli
