/// Evaluation: how often `locate` finds frames whose pose is known, and how far it is off.
///
///     const std::vector<TruthRow> rows = read_truth("frames/truth.csv");
///     FrameRun run;
///     run.frames = static_cast<int>(rows.size());
///     run.frame_at = frames_of_folder("frames", rows);
///     const Score score = score_of(evaluate(run).front());
///
/// `frames_of_setup` simulates the frames instead. The paper's own experiment (section IV) is
/// `run_protocol` (protocol.hpp); `run_sweep` (sweep.hpp) worsens one condition step by step.
///
/// All results but the times depend on the frames alone, not on the number of threads. Functions
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

struct KnownFrame {
    GreyImage image;
    Truth truth;
    std::optional<Profile> profile;  ///< replaces that of the options
    std::string problem;             ///< why there is no image; empty if there is one
};

/// Gives frame `index`. Called from several threads; must depend on the index alone.
using FrameSource = std::function<KnownFrame(int index)>;

/// The files of a truth.csv. A file that cannot be read becomes a frame with a `problem`.
FrameSource frames_of_folder(const std::filesystem::path& folder, std::vector<TruthRow> rows);

/// `draw_shot(setup, index)`, rendered.
FrameSource frames_of_setup(const Setup& setup);

/// Told now and then, from the calling thread; false gives the work up with an Error.
using Progress = std::function<bool(int done, int total)>;

struct FrameRun {
    int frames = 0;
    FrameSource frame_at;
    /// Every frame is located with each of these.
    std::vector<Options> options = {Options{}};
    /// Frames that do not tell their profile are read in any, each by itself.
    bool any_code = false;
    /// Refines a fix that was just made, from the trace that its frame left, as `with_camera` does.
    /// Without it fixes stay as they are. Called from several threads; its time does not count.
    std::function<Fix(const Fix&, const Trace&)> refine;
    int threads = 0;  ///< 0: one for each core
    Progress progress;
};

/// outcomes[k][i]: frame i, located with options[k].
std::vector<std::vector<Outcome>> evaluate(const FrameRun& run);

}  // namespace dotpose

#pragma GCC visibility pop
