/// dotpose in one call: `Fix fix = locate(image, options, workspace)`.
///
/// Or row by row, as a camera delivers them, without a frame buffer: `begin`, then `push_row` for
/// every row from the top, then `finish`. `locate` does just that.
///
/// Dots are dark on light paper. Who sees white dots on black inverts the pixels first:
///
///     for (std::uint8_t& grey : pixels) grey = 255 - grey;
///
/// Memory: the caller owns one workspace for each thread (LargeWorkspace is about 1 MB: make it
/// static or on the heap) and may use it for any number of frames; afterwards it shows every
/// stage's output. Nothing is allocated, printed or thrown; there are no globals. Calls with
/// different workspaces may run at the same time.
#pragma once

#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/workspace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Images this size can be located, in pixels per side.
inline constexpr int kMinFrameSide_px = 64;
inline constexpr int kMaxFrameSide_px = 4096;

/// Where the pattern is seen in an image; see Fix. The same image gives the same bits everywhere,
/// but for the covariance and the residual.
Fix locate(const ImageView& image, const Options& options, Workspace& workspace);

/// The same, beginning where the prediction has the pattern. What the frame does not confirm is
/// located afresh; `Fix::attempt` tells.
Fix locate(const ImageView& image, const Options& options, const Prediction& prediction,
           Workspace& workspace);

/// Starts a frame. Errors: bad_argument, image_too_small, image_too_large (for the workspace).
Status begin(int width_px, int height_px, const Options& options, Workspace& workspace);

/// Starts a frame of which dots are measured where the prediction has them, as their rows come in;
/// `finish_device` ends it. A prediction that the frame does not confirm gives `not_tracked`: who
/// can push the rows again then locates it afresh.
Status begin(int width_px, int height_px, const Options& options, const Prediction& prediction,
             Workspace& workspace);

/// Takes the next row of `width_px` pixels; the pixels are not needed afterwards.
void push_row(const std::uint8_t* pixels, const Options& options, Workspace& workspace);

/// Locates once all `height_px` rows have been pushed.
Fix finish(const Options& options, Workspace& workspace);

/// The same as `finish` in integers only and in little, bounded time, whatever `options.effort` and
/// `options.decoder` say: for a camera that looks straight at the paper. Gives neither covariance
/// nor residual. What may be wrong with more than the limit by a quick estimate is refused, with
/// not_certain.
Fix finish_device(const Options& options, Workspace& workspace);

}  // namespace dotpose

#pragma GCC visibility pop
