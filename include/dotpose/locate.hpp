/// dotpose in one object:
///
///     dotpose::Locator locator;
///     if (const dotpose::Fix fix = locator.locate(image)) use(fix.x_mm(), fix.y_mm());
///
/// An image can also be pushed row by row, as a camera delivers it: `begin`, then `push_row` for
/// every row from the top, then `finish`. A DeviceLocator needs no frame buffer for that.
///
/// Dots are dark on light paper. For white dots on black, invert the pixels first:
///
///     for (std::uint8_t& grey : pixels) grey = 255 - grey;
///
/// Memory: a Locator allocates its own once, when it is made, or uses what the caller gives it. For
/// a frame nothing is allocated, printed or thrown; there are no globals. Different locators may
/// work at the same time.
#pragma once

#include <concepts>

#include "dotpose/code_evidence.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/locator_options.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/trace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

namespace core {
struct Workspace;
}  // namespace core

/// Base of Locator and DeviceLocator: options, memory and the state of a frame whose rows are
/// pushed.
class RowLocator {
  public:
    RowLocator(const RowLocator&) = delete;
    RowLocator& operator=(const RowLocator&) = delete;

    /// Returns the options in use.
    const Options& options() const { return options_; }
    /// Sets the options of the frames to come. A frame that was begun and not finished is dropped.
    void set_options(const Options& options);

    /// Returns the results of each stage for the last frame. A DeviceLocator's stages use the same
    /// memory one after the other, so only what the last one left is whole.
    Trace trace() const;

  protected:
    RowLocator(core::Workspace* workspace, const Options& options)
        : workspace_(workspace), options_(options) {}
    ~RowLocator() = default;

    /// Notes whether there is a frame whose rows are pushed, and how many it has. Returns `status`.
    Status note_begin(Status status, int height_px);
    /// Counts a row. Returns false if the frame has no more rows.
    bool takes_row();
    /// Returns true if a frame was begun; if not, sets the status of the fix.
    bool has_rows();
    /// Ends the frame and returns its fix, with the spacing in millimetres.
    Fix finished();

    core::Workspace* workspace_;
    Options options_;

  private:
    Status begun_ = Status::bad_argument;  ///< status of the frame whose rows are pushed
    int rows_left_ = 0;
};

/// Finds where the pattern is seen in an image.
class Locator : public RowLocator {
  public:
    /// Owns a LargeMemory on the heap. Options outside of their ranges give every frame the status
    /// bad_argument; `bad_option` names the option.
    explicit Locator(const LocatorOptions& options = {}) : Locator(new LargeMemory, options) {}
    /// The memory must outlive the locator, and no other locator may use it meanwhile.
    explicit Locator(SmallMemory& memory, const LocatorOptions& options = {})
        : Locator(memory.workspace_, options) {
        detects_code_ = !options.code;
    }
    explicit Locator(LargeMemory& memory, const LocatorOptions& options = {})
        : Locator(memory.workspace_, options) {
        detects_code_ = !options.code;
    }
    // Constructors for fixed-point options, which always name the code. They are templates to make
    // `Locator(memory, {...})` select LocatorOptions.
    template <std::same_as<Options> Fixed>
    explicit Locator(const Fixed& options) : Locator(new LargeMemory, options) {}
    template <std::same_as<Options> Fixed>
    Locator(SmallMemory& memory, const Fixed& options) : Locator(memory.workspace_, options) {}
    template <std::same_as<Options> Fixed>
    Locator(LargeMemory& memory, const Fixed& options) : Locator(memory.workspace_, options) {}
    ~Locator() { delete owned_; }

    /// Sets the options of the frames to come. A frame that was begun and not finished is dropped,
    /// and the code is detected anew unless it is given.
    void set_options(const LocatorOptions& options) {
        set_fixed_options(options);
        detects_code_ = !options.code;
    }
    template <std::same_as<Options> Fixed>
    void set_options(const Fixed& options) {
        set_fixed_options(options);
    }

    /// Returns the pose of an image; see Fix. If the options do not name the code, it is detected
    /// from all images so far, and `options().code` is the one that was read. The same image
    /// gives the same bits on every processor, except in the covariance and the residual.
    Fix locate(const ImageView& image);

    /// Looks for the pattern where the prediction expects it. A frame that does not confirm the
    /// prediction is located without it; `Fix::attempt` says which. The prediction must have been
    /// made in `options().code`.
    Fix locate(const ImageView& image, const Prediction& prediction);

    /// Locates an image whose code variant is not known. Places in all code variants are
    /// alternatives, weighed with the odds in `evidence`; a frame that places of two code variants
    /// explain about equally well gets the status ambiguous_code. Afterwards `options().code` is
    /// the code variant that was read.
    CodeReading locate_in_any_code(const ImageView& image, const CodeEvidence& evidence);

    /// Locates an image whose code variant is not known, first where the prediction expects the
    /// pattern. The prediction must have been made in `options().code`.
    CodeReading locate_in_any_code(const ImageView& image, const Prediction& prediction,
                                   const CodeEvidence& evidence);

    /// Locates an image in `options().code`, with the same fix as `locate`. `has_other` says
    /// whether another code variant also explains the image without a contradiction, at another
    /// place or where `options().code` has none.
    CodeReading locate_in_code(const ImageView& image);

    /// Starts an image that arrives row by row, with a prediction or without. The locator keeps the
    /// rows. Errors: bad_argument; image_too_small; image_too_large (more pixels than the memory
    /// keeps: 188 x 188 for a SmallMemory, 1280 x 1024 for a LargeMemory).
    Status begin(int width_px, int height_px);
    Status begin(int width_px, int height_px, const Prediction& prediction);
    /// Takes the next row of `width_px` pixels. Further rows than the image has are ignored.
    void push_row(const std::uint8_t* pixels);
    /// Locates the image whose rows were pushed, as `locate` does. Missing rows count as white
    /// paper. Without an image that was begun: bad_argument.
    Fix finish();

  private:
    Locator(core::DesktopWorkspace* workspace, const Options& options);
    template <typename AnyOptions>
    Locator(LargeMemory* owned, const AnyOptions& options) : Locator(*owned, options) {
        owned_ = owned;
    }
    void set_fixed_options(const Options& options);
    core::DesktopWorkspace& workspace();
    CodeReading finished(CodeReading reading);
    /// Keeps the evidence of a reading and returns its fix.
    Fix detected(const CodeReading& reading);
    using RowLocator::finished;

    LargeMemory* owned_ = nullptr;
    bool detects_code_ = false;
    CodeEvidence evidence_;  ///< of all images so far, if the code is detected
};

/// A locator for microcontrollers, for a camera that looks straight at the paper: integers only, in
/// little, bounded time, whatever the options `effort` and `decoder` say. It gives neither
/// covariance nor residual. A position whose quickly estimated bound exceeds the limit is refused
/// as not_certain. A program that uses only this class links none of the desktop attempts.
class DeviceLocator : public RowLocator {
  public:
    /// Constructs as Locator does, with the same rules for memory and options.
    explicit DeviceLocator(AnyDeviceMemory& memory, const Options& options = {});

    /// Locates as the functions of Locator with the same names do.
    Fix locate(const ImageView& image);
    Fix locate(const ImageView& image, const Prediction& prediction);

    /// Starts a frame whose rows are pushed; their dots are detected as they come. Errors:
    /// bad_argument, image_too_small, image_too_large (too large for the memory).
    Status begin(int width_px, int height_px);

    /// Starts a frame whose dots are measured where the prediction expects them, as their rows come
    /// in. If the prediction cannot be used or the frame does not confirm it, the status returned,
    /// or that of `finish`, is not_tracked; a caller that still has the rows can then push them
    /// again without a prediction.
    Status begin(int width_px, int height_px, const Prediction& prediction);

    /// Takes the next row of `width_px` pixels, which need not stay valid afterwards. Rows beyond
    /// the height of the frame are ignored.
    void push_row(const std::uint8_t* pixels);

    /// Locates the frame whose rows were pushed. Without a frame that was begun: bad_argument.
    Fix finish();

  private:
    core::DeviceWorkspace& workspace();
};

}  // namespace dotpose

#pragma GCC visibility pop
