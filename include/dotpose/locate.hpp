/// Locator: computes the pose of a camera from an image of the pattern.
///
///     dotpose::Locator locator;
///     if (const dotpose::Fix fix = locator.locate(image)) use(fix.x_mm(), fix.y_mm());
///
/// An image can also be pushed row by row, as the camera delivers it: call `begin`, then `push_row`
/// for every row from the top, then `finish`. A DeviceLocator then needs no frame buffer.
///
/// Dots are dark on light paper. For white dots on black, invert the pixels first:
///
///     for (std::uint8_t& grey : pixels) grey = 255 - grey;
///
/// Memory: the constructor of a Locator allocates all memory, unless the caller provides it.
/// Locating a frame does not allocate, print or throw. There are no global variables. Different
/// locators may be used concurrently. A Locator uses up to 300 KB of stack.
#pragma once

#include <concepts>
#include <optional>
#include <span>

#include "dotpose/code_evidence.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/error_rate.hpp"
#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/known_region.hpp"
#include "dotpose/locator_options.hpp"
#include "dotpose/measured_motion.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/trace.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

namespace core {
struct Workspace;
}  // namespace core

/// Base class of Locator and DeviceLocator. Holds the options, the memory, and the state of a frame
/// that is pushed row by row.
class RowLocator {
  public:
    RowLocator(const RowLocator&) = delete;
    RowLocator& operator=(const RowLocator&) = delete;

    /// Returns the options in use.
    const DeviceOptions& options() const { return options_; }
    /// Sets the options for the following frames. Discards a frame that was begun but not finished.
    void set_options(const DeviceOptions& options);

    /// Returns the results of each stage for the last frame. The stages of a DeviceLocator share
    /// memory, so only the results of its last stage are complete.
    Trace trace() const;

  protected:
    RowLocator(core::Workspace* workspace, const DeviceOptions& options)
        : workspace_(workspace), options_(options) {}
    ~RowLocator() = default;

    /// Stores the status that `begin` returns, and the height of the frame. Returns `status`.
    Status note_begin(Status status, int height_px);
    /// Counts a pushed row. Returns false if all rows of the frame have already been pushed.
    bool takes_row();
    /// Returns true if a frame was begun. Otherwise, sets the status of the fix to the status that
    /// `begin` returned, or to bad_argument if `begin` was not called.
    bool has_rows();
    /// Ends the frame. Sets the spacing of its fix from the options, and returns the fix.
    Fix finished();

    core::Workspace* workspace_;
    DeviceOptions options_;

  private:
    /// Status that `begin` returned, or bad_argument if no frame was begun.
    Status begun_ = Status::bad_argument;
    int rows_left_ = 0;  ///< number of rows that have not been pushed yet
};

/// Computes the pose of the camera relative to the pattern.
class Locator : public RowLocator {
  public:
    /// Allocates a LargeMemory on the heap. If any option is out of range, every frame fails with
    /// bad_argument, and `bad_option` returns the name of the option.
    explicit Locator(const LocatorOptions& options = {}) : Locator(new LargeMemory, options) {}
    /// Uses `memory`, which must outlive the locator. No other locator may use this memory while
    /// this locator exists.
    explicit Locator(SmallMemory& memory, const LocatorOptions& options = {})
        : Locator(memory.workspace_, options) {
        detects_code_ = !options.code;
    }
    explicit Locator(LargeMemory& memory, const LocatorOptions& options = {})
        : Locator(memory.workspace_, options) {
        detects_code_ = !options.code;
    }
    // Overloads for fixed-point options, which always contain the code. They are templates so that
    // `Locator(memory, {...})` selects LocatorOptions.
    template <std::same_as<DeviceOptions> Fixed>
    explicit Locator(const Fixed& options) : Locator(new LargeMemory, options) {}
    template <std::same_as<DeviceOptions> Fixed>
    Locator(SmallMemory& memory, const Fixed& options) : Locator(memory.workspace_, options) {}
    template <std::same_as<DeviceOptions> Fixed>
    Locator(LargeMemory& memory, const Fixed& options) : Locator(memory.workspace_, options) {}
    ~Locator() { delete owned_; }

    /// Sets the options for the following frames. Discards a frame that was begun but not finished.
    /// Restarts the measurement of the error rate and, unless the options contain the code, the
    /// detection of the code.
    void set_options(const LocatorOptions& options) {
        set_fixed_options(options);
        detects_code_ = !options.code;
    }
    template <std::same_as<DeviceOptions> Fixed>
    void set_options(const Fixed& options) {
        set_fixed_options(options);
    }

    /// Sets the known regions: the rectangles of the code plane that are printed on the sheets that
    /// may be in view. With known regions, a view of about 30 dots is sufficient for a fix. The
    /// locator does not copy the regions, so the array must remain valid until other regions are
    /// set or the locator is destroyed. An empty span removes all regions. Returns bad_argument,
    /// and keeps the previous regions, if a region is empty, extends beyond the plane, or has an
    /// invalid code or section. With Effort::device, the regions are searched as described for
    /// DeviceLocator::set_known.
    Status set_known(std::span<const KnownRegion> regions,
                     OtherSheets others = OtherSheets::possible);

    /// Locates the pattern in an image. If the options do not contain the code, detects the code
    /// from all images so far, and sets `options().code` to the code of the fix. The fix is
    /// bit-identical on all processors, except for the covariance and the residual.
    Fix locate(const ImageView& image);

    /// Locates the pattern near the predicted place. If the image does not confirm the prediction,
    /// locates the image without the prediction. `Fix::attempt` reports which attempt succeeded.
    /// The prediction must have been made in `options().code`.
    Fix locate(const ImageView& image, const Prediction& prediction);

    /// Locates an image from a camera that has moved by `since_last` since the previous image. If
    /// the previous image was located, first searches near the place that the motion predicts.
    ///
    /// Consecutive calls that pass a motion form a series, which may include images without a
    /// pattern. If the current image alone does not make the position certain, its bits are
    /// combined with those of the previous images in the series. A moving camera can therefore
    /// obtain a fix from views that are individually too small or too dirty. `Fix::frames` is the
    /// number of images whose bits were combined.
    ///
    /// A call without a motion ends the series. A call with an unusable motion (see
    /// `MeasuredMotion::is_usable`), or with an unknown spacing of the printed grid, also ends the
    /// series, and locates its image without the previous images.
    Fix locate(const ImageView& image, const MeasuredMotion& since_last);

    /// Locates an image whose code variant is not known. Considers places in all code variants,
    /// weighted by the odds in `evidence`. If places in two code variants explain the image about
    /// equally well, the status is ambiguous_code. Sets `options().code` to `CodeReading::code`,
    /// the code variant of the result.
    CodeReading locate_in_any_code(const ImageView& image, const CodeEvidence& evidence);

    /// Locates an image whose code variant is not known, and tries the predicted place first. The
    /// prediction must have been made in `options().code`.
    CodeReading locate_in_any_code(const ImageView& image, const Prediction& prediction,
                                   const CodeEvidence& evidence);

    /// Locates an image whose code variant is not known, after the camera has moved by
    /// `since_last`. Uses the motion in the same way as `locate`.
    CodeReading locate_in_any_code(const ImageView& image, const MeasuredMotion& since_last,
                                   const CodeEvidence& evidence);

    /// Locates an image in `options().code`. Returns the same fix as `locate`, but also sets
    /// `has_other` in three cases:
    /// - A different place, in another code variant, explains the image about as well as the place
    ///   of the fix.
    /// - The place of the fix explains the image much better if it is read in another code variant.
    /// - The image has no fix in `options().code`, but a place in another code variant explains the
    ///   image with few wrong bits.
    CodeReading locate_in_code(const ImageView& image);

    /// Returns the bits of the last frame that were compared with the code: at its fix or, if no
    /// fix was certain, at the position with the fewest wrong bits. Nothing is compared if no
    /// position is found, or with Effort::device.
    ComparedBits compared_bits() const;
    /// Returns the error rate, measured over all frames since the options were set. Set
    /// `bits_per_error` to kMeasuredErrorRate to use it.
    const ErrorRate& error_rate() const { return error_rate_; }

    /// Starts an image that is pushed row by row, with or without a prediction. The locator stores
    /// the rows. Errors: bad_argument, image_too_small, image_too_large. An image is too large if
    /// it is wider than the memory supports, or if it has more pixels than the memory can store:
    /// 188 x 188 for a SmallMemory, 1280 x 1024 for a LargeMemory.
    Status begin(int width_px, int height_px);
    Status begin(int width_px, int height_px, const Prediction& prediction);
    /// Appends the next row of `width_px` pixels. Ignores rows beyond the height of the image. Also
    /// ignores all rows if `begin` was not called.
    void push_row(const std::uint8_t* pixels);
    /// Locates the image whose rows were pushed, in the same way as `locate`. Missing rows are
    /// treated as white paper. If `begin` failed, the fix has the status that `begin` returned. If
    /// `begin` was not called, the status is bad_argument.
    Fix finish();

  private:
    Locator(core::DesktopWorkspace* workspace, const DeviceOptions& options);
    template <typename AnyOptions>
    Locator(LargeMemory* owned, const AnyOptions& options) : Locator(*owned, options) {
        owned_ = owned;
    }
    void set_fixed_options(const DeviceOptions& options);
    core::DesktopWorkspace& workspace();
    /// Returns the options for the next frame: `options_`, with the measured error rate if it
    /// contains kMeasuredErrorRate.
    DeviceOptions options_of_frame() const;
    Fix locate_one(const ImageView& image, const Prediction* prediction);
    CodeReading read_one(const ImageView& image, const Prediction* prediction,
                         const CodeEvidence& evidence);
    /// Adds the motion `since_last` to the series, and returns the prediction for the image that is
    /// about to be located. Returns nullopt if the previous image was not located. If the motion is
    /// not usable or the spacing is unknown, ends the series and returns nullopt.
    std::optional<Prediction> begin_motion(const MeasuredMotion& since_last);
    CodeReading finished(CodeReading reading);
    using RowLocator::finished;

    LargeMemory* owned_ = nullptr;
    bool detects_code_ = false;
    CodeEvidence evidence_;  ///< evidence from all images so far, if the code is detected
    ErrorRate error_rate_;
};

/// A locator for microcontrollers with a camera that looks straight at the paper. Uses only integer
/// arithmetic, with a short and bounded time per frame. Ignores the options `effort` and `decoder`,
/// and computes neither a covariance nor a residual. Its bound on the probability of a wrong
/// position is simpler than that of a Locator. Positions whose bound exceeds
/// IntegrityOptions::max_p_wrong_log2 are rejected as not_certain. A program that uses only this
/// class does not link the code of Locator.
class DeviceLocator : public RowLocator {
  public:
    /// Uses `memory`, which must outlive the locator. No other locator may use this memory while
    /// this locator exists. If any option is out of range, every frame fails with bad_argument.
    explicit DeviceLocator(AnyDeviceMemory& memory, const DeviceOptions& options = {});

    /// Sets the known regions (see Locator::set_known). `locate` and `finish` then search the
    /// regions first, and the rest of the plane only if other sheets are possible. They ignore
    /// regions in a code other than `options().code`. The search needs no additional memory. The
    /// search time is proportional to the total number of columns and rows of all regions, so use
    /// few regions.
    Status set_known(std::span<const KnownRegion> regions,
                     OtherSheets others = OtherSheets::possible);

    /// Locates the pattern in an image, using the code `options().code`.
    Fix locate(const ImageView& image);
    /// Locates the pattern by measuring the dots at their predicted positions. If the image does
    /// not confirm the prediction, locates the image without the prediction.
    Fix locate(const ImageView& image, const Prediction& prediction);

    /// Starts a frame that is pushed row by row. The dots of each row are detected as the row
    /// arrives. Errors: bad_argument, image_too_small, image_too_large (too large for the memory).
    Status begin(int width_px, int height_px);

    /// Starts a frame whose dots are measured at their predicted positions as the rows arrive.
    /// Returns not_tracked if the prediction cannot be used. If the frame does not confirm the
    /// prediction, the fix that `finish` returns has the status not_tracked. A caller that has kept
    /// the rows can then push them again, without the prediction.
    Status begin(int width_px, int height_px, const Prediction& prediction);

    /// Processes the next row of `width_px` pixels. The pixels need not remain valid afterwards.
    /// Ignores rows beyond the height of the frame. Also ignores all rows if `begin` was not
    /// called.
    void push_row(const std::uint8_t* pixels);

    /// Locates the frame whose rows were pushed. If `begin` failed, the fix has the status that
    /// `begin` returned. If `begin` was not called, the status is bad_argument.
    Fix finish();

  private:
    core::DeviceWorkspace& workspace();
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
