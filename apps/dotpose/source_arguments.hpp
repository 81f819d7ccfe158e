/// Arguments for the sources of frames, used by all commands that read frames.
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

/// Help text of the positional argument for sources.
inline constexpr const char* kSourcesHelp =
    "Images, folders, globs ('*.png'), videos, cameras (0, /dev/video0, URL), or - for raw frames";

struct SourceArguments {
    std::vector<std::string> names;
    std::string list;  ///< file of further names, "-" for standard input, or empty for none
    capture::SourceOptions options;

    bool is_given() const { return !names.empty() || !list.empty(); }

    /// Returns the number of uses of standard input, as the list or as raw frames.
    std::int64_t reads_of_standard_input() const;

    /// Adds the sources, --list, and the options for cameras, videos and raw frames.
    void add_to(Command& command);

    /// Adds only --size, --fps, --exposure, --gain, --flip and --roi.
    void add_frame_options(Command& command);

    /// Enables flipping if the camera file requires it, and clears the flag in `camera`, because
    /// the source then delivers flipped frames.
    void flip_as(std::optional<Camera>& camera);

    /// Calls `flip_as`. If --roi is given and the camera file describes whole frames, restricts
    /// `camera` to the region and returns true. Throws BadArgument if the region is not within the
    /// image.
    bool fit_to(std::optional<Camera>& camera);
};

/// All sources of one run.
class Sources {
  public:
    /// Collects the sources. If one of them is a camera or a video, which only dotpose-live can
    /// read, `dotpose` replaces this process with dotpose-live (live_sources.hpp). Therefore no
    /// output may be open yet. Throws BadArgument if no source is given, or if standard input is
    /// given twice. Throws Error if the list, a folder or a glob cannot be read.
    explicit Sources(const SourceArguments& arguments);

    /// Returns true if a pipe may still deliver names.
    bool has_pipe() const { return names_.has_pipe(); }

    /// Registers the list file and all input files whose names are already known.
    void add_files(RunFiles& files) const;

    /// Returns all names. Waits for all names from a pipe.
    std::vector<std::string> all_names();

    /// Returns the paths of all images. Waits for all names from a pipe. Throws Error if a folder
    /// or glob cannot be read, and BadArgument if a source is not an image.
    std::vector<std::string> all_images();

    /// Returns the number of images. Returns 0 if it is unknown, because there are other sources or
    /// a pipe.
    std::int64_t number_of_images() const;

    /// Opens all sources as one sequence of frames. This object must outlive the result.
    std::unique_ptr<capture::SourceList> open(capture::SourceOptions options);

  private:
    std::string list_;
    SourceNames names_;
};

}  // namespace dotpose::cli
