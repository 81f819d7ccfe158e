/// --calibrate-to: the camera file that the page of `dotpose watch --web` calibrates.
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

    /// If --camera is not given and the file of --calibrate-to exists, uses this file as the camera
    /// file of the run. Throws Error if it is not a camera file.
    void use_replaced_camera(FollowerArguments& follower) const;

    /// Throws BadArgument if --calibrate-to is given without --web.
    void require_page(const WebArguments& web) const;

    /// Throws Error if the file cannot be written.
    void require_writable_file() const;

    /// Registers the sheet file and the camera files as inputs, and the file of --calibrate-to as
    /// output. This file may be the file of --camera.
    void add_files(const FollowerArguments& follower, RunFiles& files) const;

    /// Returns the options of the calibration, or none without --calibrate-to.
    std::optional<GuideOptions> options(const FollowerArguments& arguments,
                                        const SourceArguments& sources,
                                        const Follower& follower) const;

  private:
    const Command* command_ = nullptr;
    std::string file_;
};

}  // namespace dotpose::cli
