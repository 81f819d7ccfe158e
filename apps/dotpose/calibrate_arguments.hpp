// Command-line options of `dotpose calibrate`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate_report.hpp"
#include "common.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "live_calibration.hpp"
#include "source_arguments.hpp"

namespace dotpose::cli {

struct CalibrateArguments {
    SourceArguments sources;
    bool is_live = false;
    LiveCalibrationOptions live;
    std::vector<std::string> spin;
    std::vector<std::string> drive;
    std::vector<std::string> pivot;
    std::vector<std::string> rolling;
    std::vector<std::string> flat;
    std::vector<std::string> print_map;
    bool stitch = false;
    ScaleReference reference;
    std::string sheets;
    SpacingSource spacing = SpacingSource::assumed;
    CameraArgument camera;
    std::string out;
    std::string picture;
    std::optional<CodeVariant> code;  ///< nullopt to detect the code from the frames
    CalibrateOptions options;

    void add_to(Command& command);
};

}  // namespace dotpose::cli
