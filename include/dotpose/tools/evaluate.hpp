/// Evaluation: success rate and errors of `locate` for frames with known poses.
///
///     const std::vector<TruthRow> rows = read_truth("frames/truth.csv");
///     FrameRun run;
///     run.frames = static_cast<int>(rows.size());
///     run.frame_at = frames_of_folder("frames", rows);
///     const Score score = score_of(evaluate(run).front());
///
/// `frames_of_setup` simulates the frames instead. `run_protocol` (protocol.hpp) simulates the
/// paper's experiment (section IV). `run_sweep` (sweep.hpp) degrades one condition step by step.
///
/// Apart from the measured times, results depend only on the frames, not on the number of threads.
/// The functions share no state. They throw Error for problems with files and BadArgument for
/// invalid arguments.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/outcome.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/truth.hpp"
#include "dotpose/trace.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// A frame with its true pose.
struct KnownFrame {
    GreyImage image;
    Truth truth;
    /// Code variant of this frame. Overrides the code variant in the options.
    std::optional<CodeVariant> code;
    std::string problem;  ///< reason why there is no image, or empty
};

/// Returns frame `index`. The result must depend only on the index, because the function is called
/// from several threads.
using FrameSource = std::function<KnownFrame(int index)>;

/// Returns a source that reads the images listed in a truth.csv file. An image that cannot be read
/// becomes a frame with a `problem`.
FrameSource frames_of_folder(const std::filesystem::path& folder, std::vector<TruthRow> rows);

/// Returns a source that renders frame `index` as the shot `draw_shot(setup, index)`.
FrameSource frames_of_setup(const Setup& setup);

/// Called regularly, from the thread that called `evaluate`. Returning false aborts the evaluation
/// with an Error.
using Progress = std::function<bool(int done, int total)>;

/// The frames to locate, and the options for `locate`.
struct FrameRun {
    int frames = 0;
    FrameSource frame_at;
    /// Sets of options for `locate`. Every frame is located with each set.
    std::vector<DeviceOptions> options = {DeviceOptions{}};
    /// True to detect the code variant of each frame for which `KnownFrame::code` is not set. The
    /// code variant is detected independently for each frame.
    bool any_code = false;
    /// Refines a fix, given the trace of its frame, for example by calling `with_camera`. If the
    /// function is empty, fixes are not refined. Called from several threads. The measured times do
    /// not include the refinement.
    std::function<Fix(const Fix&, const Trace&)> refine;
    int threads = 0;  ///< number of threads, or 0 for one per core
    Progress progress;
};

/// Locates all frames. Element [k][i] of the result is the outcome of frame i with options[k].
/// Throws BadArgument if there is no `frame_at` or `frames` is negative, and Error if `progress`
/// returned false. Exceptions thrown by `frame_at` abort the evaluation and propagate to the
/// caller.
std::vector<std::vector<Outcome>> evaluate(const FrameRun& run);

}  // namespace dotpose

DOTPOSE_END_EXPORT
