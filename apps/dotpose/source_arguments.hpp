/// Command-line arguments for frame sources, shared by all commands that read frames.
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

/// Help text for the positional argument that names the sources.
inline constexpr const char* kSourcesHelp =
    "Images, folders, globs ('*.png'), videos, cameras (0, /dev/video0, URL), or - for raw frames";

struct SourceArguments {
    std::vector<std::string> names;
    std::string list;  ///< file with more names, "-" for standard input, or empty for none
    capture::SourceOptions options;

    bool is_given() const { return !names.empty() || !list.empty(); }

    /// Returns the number of times that standard input is named, as a source or as the list.
    std::int64_t reads_of_standard_input() const;

    /// Adds the sources, --list, and the options for cameras, videos and raw frames.
    void add_to(Command& command);

    /// Adds only --size, --fps, --exposure, --gain, --flip and --roi.
    void add_frame_options(Command& command);

    /// If the `flip` flag is set in `camera`, makes the sources flip their frames. Then clears the
    /// flag, because the frames from the sources are already flipped.
    void flip_as(std::optional<Camera>& camera);

    /// Calls `flip_as`. If --roi is given and the camera file describes full frames, restricts
    /// `camera` to the region and returns true. Throws BadArgument if the region is not inside the
    /// image.
    bool fit_to(std::optional<Camera>& camera);
};

/// All sources of one run.
class Sources {
  public:
    /// Collects the sources. Only dotpose-live can read cameras and videos. If a source is a camera
    /// or a video, `dotpose` therefore replaces this process with dotpose-live (live_sources.hpp),
    /// so outputs must be opened later. Throws BadArgument if no source is given or if standard
    /// input is given twice. Throws Error if the list, a folder or a glob cannot be read.
    explicit Sources(const SourceArguments& arguments);

    /// Returns true if the list is standard input or a pipe, so its names are not known in advance.
    bool has_pipe() const { return names_.has_pipe(); }

    /// Registers the list file and all input files that are already known.
    void add_files(RunFiles& files) const;

    /// Returns all names. Blocks until a pipe, if there is one, has delivered all its names.
    std::vector<std::string> all_names();

    /// Returns the paths of all images. Blocks like `all_names`. Throws Error if a folder or a glob
    /// cannot be read. Throws BadArgument if a source is not an image.
    std::vector<std::string> all_images();

    /// Returns the number of images. Returns 0 if the number is unknown because image names are
    /// read from a pipe, a source cannot be read, or a source does not consist of images.
    std::int64_t number_of_images() const;

    /// Opens all sources as one sequence of frames. `*this` must outlive the result.
    std::unique_ptr<capture::SourceList> open(capture::SourceOptions options);

  private:
    std::string list_;
    SourceNames names_;
};

}  // namespace dotpose::cli
