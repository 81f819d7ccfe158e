/// Evaluation: how often `locate` finds frames whose pose is known, and how large its errors are.
///
///     const std::vector<TruthRow> rows = read_truth("frames/truth.csv");
///     FrameRun run;
///     run.frames = static_cast<int>(rows.size());
///     run.frame_at = frames_of_folder("frames", rows);
///     const Score score = score_of(evaluate(run).front());
///
/// `frames_of_setup` simulates the frames instead. `run_protocol` (protocol.hpp) repeats the
/// paper's own experiment (section IV); `run_sweep` (sweep.hpp) worsens one condition step by step.
///
/// Apart from times, results depend on the frames alone, not on the number of threads. Functions
/// share no state. Errors of files and arguments are thrown as Error and BadArgument.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/error.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/outcome.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/truth.hpp"
#include "dotpose/trace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// A frame with its true pose.
struct KnownFrame {
    GreyImage image;
    Truth truth;
    std::optional<Profile> profile;  ///< profile of this frame, in place of that of the options
    std::string problem;             ///< reason why there is no image; empty if there is one
};

/// Returns frame `index`. Called from several threads, so it must depend on the index alone.
using FrameSource = std::function<KnownFrame(int index)>;

/// Returns the images that a truth.csv lists. A file that cannot be read becomes a frame with a
/// `problem`.
FrameSource frames_of_folder(const std::filesystem::path& folder, std::vector<TruthRow> rows);

/// Returns the frames of `draw_shot(setup, index)`, rendered.
FrameSource frames_of_setup(const Setup& setup);

/// Called now and then from the calling thread; false stops the work with an Error.
using Progress = std::function<bool(int done, int total)>;

/// The frames to locate, and how.
struct FrameRun {
    int frames = 0;
    FrameSource frame_at;
    /// Every frame is located with each of these options.
    std::vector<Options> options = {Options{}};
    /// Whether frames without a known profile are read in all profiles, each frame by itself.
    bool any_code = false;
    /// Refines a new fix from the trace of its frame, as `with_camera` does; none: fixes stay as
    /// they are. Called from several threads; its time does not count.
    std::function<Fix(const Fix&, const Trace&)> refine;
    int threads = 0;  ///< 0: one for each core
    Progress progress;
};

/// Locates all frames; outcomes[k][i] is that of frame i with options[k].
std::vector<std::vector<Outcome>> evaluate(const FrameRun& run);

}  // namespace dotpose

#pragma GCC visibility pop
