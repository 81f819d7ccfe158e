/// The arguments that say where frames come from, which all commands that read frames share.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/source_list.hpp"
#include "command_line.hpp"
#include "dotpose/files/camera.hpp"
#include "run_files.hpp"
#include "source_names.hpp"

namespace dotpose::cli {

/// The help text of the sources that a command takes.
inline constexpr const char* kSourcesHelp =
    "Images, folders, globs ('*.png'), videos, cameras (0, /dev/video0, URL), or - for raw frames";

struct SourceArguments {
    std::vector<std::string> names;
    std::string list;  ///< file with further names, "-" for standard input, or empty
    capture::SourceOptions options;

    bool is_given() const { return !names.empty() || !list.empty(); }

    /// Returns how often standard input is named, as the list or for raw frames.
    std::int64_t reads_of_standard_input() const;

    /// Adds the sources, --list and the options of cameras, videos and raw frames.
    void add_to(Command& command);

    /// Adds --size, --fps, --exposure, --gain, --flip and --roi alone.
    void add_frame_options(Command& command);

    /// Flips frames if the camera file says so, and clears its flag: its frames come flipped.
    void flip_as(std::optional<Camera>& camera);

    /// Calls `flip_as`. With --roi, also reduces the camera of whole frames to the part, and
    /// returns true. Throws BadArgument if the part exceeds the images of the camera.
    bool fit_to(std::optional<Camera>& camera);
};

/// The sources of one run.
class Sources {
  public:
    /// If a camera or a video is among them that this program cannot read, the program that can
    /// takes the place of this process (live_sources.hpp): make this object before any output is
    /// opened. Throws BadArgument if no source is named, or if standard input is named twice;
    /// Error if the list, a folder or a glob cannot be read.
    explicit Sources(const SourceArguments& arguments);

    /// Whether names may follow that are not known yet.
    bool has_pipe() const { return names_.has_pipe(); }

    /// Registers the list and all files that are known from the start.
    void add_files(RunFiles& files) const;

    /// Returns all names, those in a pipe too.
    std::vector<std::string> all_names();

    /// Returns the paths of all images, those of names in a pipe too. Throws Error if a folder or
    /// glob cannot be read, and BadArgument if there are other sources.
    std::vector<std::string> all_images();

    /// Returns the number of all images, or 0 if there are other sources or names in a pipe.
    std::int64_t number_of_images() const;

    /// Returns the frames of all sources. This object must outlive them.
    std::unique_ptr<capture::SourceList> open(capture::SourceOptions options);

  private:
    std::string list_;
    SourceNames names_;
};

}  // namespace dotpose::cli
