/// The --calibrate-to option, which names the camera file in which the web page of
/// `dotpose watch --web` saves calibrations.
#pragma once

#include <optional>
#include <string>

#include "calibration_guide.hpp"
#include "command_line.hpp"
#include "follower_arguments.hpp"
#include "run_files.hpp"
#include "source_arguments.hpp"
#include "web_arguments.hpp"

namespace dotpose::cli {

class PageCalibrationArguments {
  public:
    /// Adds --calibrate-to. `command` must outlive this object.
    void add_to(Command& command);

    /// If the file given to --calibrate-to exists and --camera is not given, uses this file as the
    /// camera file of the run. Throws Error if the file is not a camera file.
    void use_replaced_camera(FollowerArguments& follower) const;

    /// Throws BadArgument if --calibrate-to is given without --web.
    void require_page(const WebArguments& web) const;

    /// Throws Error if the file cannot be written.
    void require_writable_file() const;

    /// Registers the sheet file and the camera file as inputs, and the file given to --calibrate-to
    /// as an output. --calibrate-to may name the same file as --camera.
    void add_files(const FollowerArguments& follower, RunFiles& files) const;

    /// Returns the options for the calibration, or nullopt if --calibrate-to is not given.
    std::optional<GuideOptions> options(const FollowerArguments& arguments,
                                        const SourceArguments& sources,
                                        const Follower& follower) const;

  private:
    const Command* command_ = nullptr;
    std::string file_;
};

}  // namespace dotpose::cli
