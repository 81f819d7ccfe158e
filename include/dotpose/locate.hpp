/// dotpose in one object: `Locator locator(memory, options); Fix fix = locator.locate(image);`
///
/// Or row by row, as a camera delivers them, without a frame buffer: `begin`, then `push_row` for
/// every row from the top, then `finish`.
///
/// Dots are dark on light paper. Who sees white dots on black inverts the pixels first:
///
///     for (std::uint8_t& grey : pixels) grey = 255 - grey;
///
/// Memory: the caller gives one for each Locator (LargeMemory is 1.7 MB: make it static or let a
/// HeapLocator of the tools own it). Nothing is allocated, printed or thrown; there are no globals.
/// Different locators may work at the same time.
#pragma once

#include "dotpose/code_evidence.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/trace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Images this size can be located, in pixels per side.
inline constexpr int kMinFrameSide_px = 64;
inline constexpr int kMaxFrameSide_px = 4096;

/// Base of Locator and DeviceLocator: it holds options and memory, and takes images row by row.
class RowLocator {
  public:
    RowLocator(const RowLocator&) = delete;
    RowLocator& operator=(const RowLocator&) = delete;

    const Options& options() const { return options_; }
    /// For the frames to come. A frame that was begun and not finished is given up.
    void set_options(const Options& options);

    /// Starts a frame whose rows are pushed. Errors: bad_argument, image_too_small, image_too_large
    /// (for the memory).
    Status begin(int width_px, int height_px);

    /// Starts a frame of which dots are measured where the prediction has them, as their rows come
    /// in. A prediction that the frame does not confirm gives `not_tracked`: who can push the rows
    /// again then locates it afresh.
    Status begin(int width_px, int height_px, const Prediction& prediction);

    /// Takes the next row of `width_px` pixels; the pixels are not needed afterwards. More rows
    /// than the frame that was begun has are not looked at.
    void push_row(const std::uint8_t* pixels);

    /// Returns the results of each stage for the last frame. A DeviceLocator's stages use the same
    /// memory one after the other, so only what the last one left is whole.
    Trace trace() const;

  protected:
    RowLocator(core::Workspace* workspace, const Options& options)
        : workspace_(workspace), options_(options) {}
    ~RowLocator() = default;

    /// Whether there is a frame that was begun; the fix says why there is none.
    bool has_rows();
    /// Ends the frame: its fix, in millimetres too.
    Fix shown();

    core::Workspace* workspace_;
    Options options_;

  private:
    /// Notes whether there is a frame whose rows are pushed, and how many it has.
    void note_begin(Status status, int height_px);

    Status begun_ = Status::bad_argument;  ///< of the frame whose rows are pushed
    int rows_left_ = 0;
};

/// Finds out where the pattern is seen in an image.
class Locator : public RowLocator {
  public:
    /// The memory must outlive the locator, and no other may use it meanwhile. Options outside of
    /// their ranges make every frame a `bad_argument`.
    explicit Locator(SmallMemory& memory, const Options& options = {});
    explicit Locator(LargeMemory& memory, const Options& options = {});

    /// Where the pattern is seen in an image; see Fix. The same image gives the same bits
    /// everywhere, but for the covariance and the residual.
    Fix locate(const ImageView& image);

    /// Looks for the pattern where the prediction has it. A frame that does not confirm the
    /// prediction is located without it; `Fix::attempt` tells.
    Fix locate(const ImageView& image, const Prediction& prediction);

    /// Locates an image whose profile is not known. Places in all profiles are alternatives, with
    /// the odds that `evidence` gives these; a frame that places of two profiles explain about
    /// equally well has the status ambiguous_code. Afterwards `options().profile` is the profile
    /// that was read.
    CodeReading locate_in_any_code(const ImageView& image, const CodeEvidence& evidence);

    /// Locates an image whose profile is not known, first where the prediction has the pattern. The
    /// prediction must have been made in `options().profile`.
    CodeReading locate_in_any_code(const ImageView& image, const Prediction& prediction,
                                   const CodeEvidence& evidence);

    /// Locates an image in `options().profile`, with the same fix as `locate`. `has_other` tells
    /// whether another profile explains the image without a contradiction: at another place, or
    /// where `options().profile` has no place.
    CodeReading locate_in_code(const ImageView& image);

    /// Locates once all rows have been pushed: one attempt, in integers if that is the effort asked
    /// for. Without a frame that was begun: bad_argument.
    Fix finish();

  private:
    CodeReading shown(CodeReading reading);
    using RowLocator::shown;
};

/// A locator for microcontrollers: integers only, in little, bounded time, whatever the options
/// `effort` and `decoder` say, for a camera that looks straight at the paper. Gives neither
/// covariance nor residual. What may be wrong with more than the limit by a quick estimate is
/// refused, with not_certain. Who links it links nothing of the desktop's attempts.
class DeviceLocator : public RowLocator {
  public:
    /// See Locator's constructor.
    explicit DeviceLocator(DeviceMemory& memory, const Options& options = {});

    /// See the functions of Locator.
    Fix locate(const ImageView& image);
    Fix locate(const ImageView& image, const Prediction& prediction);
    Fix finish();
};

}  // namespace dotpose

#pragma GCC visibility pop
