// Command-line options of `dotpose watch`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "dds/publisher.hpp"
#include "follower_arguments.hpp"
#include "frame_saver.hpp"
#include "page_calibration_arguments.hpp"
#include "source_arguments.hpp"
#include "watch_outputs.hpp"
#include "web_arguments.hpp"

namespace dotpose::cli {

struct DdsArguments {
    bool is_wanted = false;
    bool is_reliable = false;
    std::optional<int> domain;

    void add_to(Command& command);
    /// Returns the options for the DDS publisher, or nullopt if --dds is not given. Throws
    /// BadArgument if the domain is taken from ROS_DOMAIN_ID and is invalid.
    std::optional<dds::PublisherOptions> publisher() const;
};

struct WatchArguments {
    SourceArguments sources;
    FollowerArguments follower;
    OutputOptions outputs;
    DdsArguments dds;
    WebArguments web;
    std::string web_recordings = ".";
    bool web_edits_sheets = false;
    PageCalibrationArguments calibration;
    SaveOptions save;
    bool lists_cameras = false;
    bool has_no_window = false;
    bool is_realtime = false;
    std::int64_t frames = 0;  ///< number of frames to process, or 0 for no limit

    void add_to(Command& command);
};

}  // namespace dotpose::cli
