/// Locator: computes the pose of a camera from an image of the pattern.
///
///     dotpose::Locator locator;
///     if (const dotpose::Fix fix = locator.locate(image)) use(fix.x_mm(), fix.y_mm());
///
/// An image can also be pushed row by row, as a camera delivers it: call `begin`, then `push_row`
/// for every row from the top, then `finish`. A DeviceLocator then needs no frame buffer.
///
/// Dots are dark on light paper. For white dots on black, invert the pixels first:
///
///     for (std::uint8_t& grey : pixels) grey = 255 - grey;
///
/// Memory: the constructor of a Locator allocates all memory, unless the caller provides it.
/// Locating a frame does not allocate, print or throw. There are no globals. Different locators may
/// be used concurrently.
#pragma once

#include <concepts>
#include <optional>
#include <span>

#include "dotpose/code_evidence.hpp"
#include "dotpose/device_options.hpp"
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

/// Base class of Locator and DeviceLocator. Contains the options, the memory, and the state of a
/// frame that is pushed row by row.
class RowLocator {
  public:
    RowLocator(const RowLocator&) = delete;
    RowLocator& operator=(const RowLocator&) = delete;

    /// Returns the options in use.
    const DeviceOptions& options() const { return options_; }
    /// Sets the options for the following frames. Drops a frame that was begun but not finished.
    void set_options(const DeviceOptions& options);

    /// Returns the results of each stage for the last frame. The stages of a DeviceLocator share
    /// memory, so only the results of its last stage are complete.
    Trace trace() const;

  protected:
    RowLocator(core::Workspace* workspace, const DeviceOptions& options)
        : workspace_(workspace), options_(options) {}
    ~RowLocator() = default;

    /// Stores the status of `begin` and the number of rows to be pushed. Returns `status`.
    Status note_begin(Status status, int height_px);
    /// Counts a row. Returns false if all rows of the frame were already pushed.
    bool takes_row();
    /// Returns true if a frame was begun. Otherwise, sets the status of the fix to the status of
    /// `begin`, or to bad_argument if `begin` was not called.
    bool has_rows();
    /// Ends the frame. Sets the spacing of the printed grid in the fix of the frame, and returns
    /// the fix.
    Fix finished();

    core::Workspace* workspace_;
    DeviceOptions options_;

  private:
    /// Status that `begin` returned, or bad_argument if no frame was begun.
    Status begun_ = Status::bad_argument;
    int rows_left_ = 0;  ///< number of rows that may still be pushed
};

/// Computes the pose of the camera relative to the pattern.
class Locator : public RowLocator {
  public:
    /// Allocates a LargeMemory on the heap. If any option is outside its range, every frame gets
    /// the status bad_argument, and `bad_option` returns the name of the option.
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
    // Overloads for fixed-point options, which always contain the code. The overloads are templates
    // because `Locator(memory, {...})` must select LocatorOptions.
    template <std::same_as<DeviceOptions> Fixed>
    explicit Locator(const Fixed& options) : Locator(new LargeMemory, options) {}
    template <std::same_as<DeviceOptions> Fixed>
    Locator(SmallMemory& memory, const Fixed& options) : Locator(memory.workspace_, options) {}
    template <std::same_as<DeviceOptions> Fixed>
    Locator(LargeMemory& memory, const Fixed& options) : Locator(memory.workspace_, options) {}
    ~Locator() { delete owned_; }

    /// Sets the options for the following frames. Drops a frame that was begun but not finished.
    /// Restarts the detection of the code, unless the options contain the code.
    void set_options(const LocatorOptions& options) {
        set_fixed_options(options);
        detects_code_ = !options.code;
    }
    template <std::same_as<DeviceOptions> Fixed>
    void set_options(const Fixed& options) {
        set_fixed_options(options);
    }

    /// Sets the regions of the code plane on the printed sheets that may be in view. With known
    /// regions, views of about 30 dots suffice. `regions` must remain valid while the locator uses
    /// it. An empty span makes all places possible again. If a region is empty, extends beyond the
    /// plane, or has an invalid code or section, keeps the previous regions and returns
    /// bad_argument. Effort::device does not use the regions.
    Status set_known(std::span<const KnownRegion> regions,
                     OtherSheets others = OtherSheets::possible);

    /// Locates the pattern in an image. If the options do not contain the code, detects the code
    /// from all images so far, and sets `options().code` to the code of the fix. The fix is
    /// bit-identical on every processor, except for the covariance and the residual.
    Fix locate(const ImageView& image);

    /// Locates the pattern near the predicted place. A frame that does not confirm the prediction
    /// is located without the prediction. `Fix::attempt` reports which attempt succeeded. The
    /// prediction must have been made in `options().code`.
    Fix locate(const ImageView& image, const Prediction& prediction);

    /// Locates an image of a camera that has moved by `since_last` since the previous image. If the
    /// previous image was located, first searches near the place that the motion predicts. If the
    /// position from this image alone is not certain, reads the image together with the previous
    /// images of the series. Views that are too small or too dirty can therefore become certain as
    /// the camera moves. `Fix::frames` is the number of images read together. The series may
    /// include images without a pattern. The series ends if another function locates an image. If
    /// the options do not contain the spacing of the printed grid, or if the motion is not usable,
    /// locates the image alone.
    Fix locate(const ImageView& image, const MeasuredMotion& since_last);

    /// Locates an image whose code variant is not known. Considers places in all code variants,
    /// weighted by the odds in `evidence`. If places of two code variants explain the frame about
    /// equally well, the status is ambiguous_code. Sets `options().code` to the code variant of the
    /// result, `CodeReading::code`.
    CodeReading locate_in_any_code(const ImageView& image, const CodeEvidence& evidence);

    /// Locates an image whose code variant is not known, and tries the predicted place first. The
    /// prediction must have been made in `options().code`.
    CodeReading locate_in_any_code(const ImageView& image, const Prediction& prediction,
                                   const CodeEvidence& evidence);

    /// Locates an image whose code variant is not known, after the camera has moved by
    /// `since_last`. Uses the motion as `locate` does.
    CodeReading locate_in_any_code(const ImageView& image, const MeasuredMotion& since_last,
                                   const CodeEvidence& evidence);

    /// Locates an image in `options().code`, with the same fix as `locate`. Sets `has_other` in
    /// three cases:
    /// - A place in another code variant, other than the place of the fix, explains the image about
    ///   as well as the fix.
    /// - The place of the fix explains the image much better in another code variant.
    /// - The image has no fix in `options().code`, but a place in another code variant explains the
    ///   image with few wrong bits.
    CodeReading locate_in_code(const ImageView& image);

    /// Starts an image that is pushed row by row, with or without a prediction. The locator stores
    /// the rows. Errors: bad_argument, image_too_small, image_too_large. An image is too large if
    /// it is wider than the memory supports, or has more pixels than the memory can store: 188 x
    /// 188 for a SmallMemory, 1280 x 1024 for a LargeMemory.
    Status begin(int width_px, int height_px);
    Status begin(int width_px, int height_px, const Prediction& prediction);
    /// Appends the next row of `width_px` pixels. Ignores rows beyond the height of the image, and
    /// all rows if no image was begun.
    void push_row(const std::uint8_t* pixels);
    /// Locates the image whose rows were pushed, as `locate` does. Missing rows count as white
    /// paper. If `begin` failed, the fix has the status of `begin`. If `begin` was not called, the
    /// status is bad_argument.
    Fix finish();

  private:
    Locator(core::DesktopWorkspace* workspace, const DeviceOptions& options);
    template <typename AnyOptions>
    Locator(LargeMemory* owned, const AnyOptions& options) : Locator(*owned, options) {
        owned_ = owned;
    }
    void set_fixed_options(const DeviceOptions& options);
    core::DesktopWorkspace& workspace();
    Fix locate_one(const ImageView& image, const Prediction* prediction);
    CodeReading read_one(const ImageView& image, const Prediction* prediction,
                         const CodeEvidence& evidence);
    /// Adds a motion to the series of images. Returns the prediction for the next image, if the
    /// previous image was located.
    std::optional<Prediction> begin_motion(const MeasuredMotion& since_last);
    CodeReading finished(CodeReading reading);
    using RowLocator::finished;

    LargeMemory* owned_ = nullptr;
    bool detects_code_ = false;
    CodeEvidence evidence_;  ///< evidence of all images so far, if the code is detected
};

/// A locator for microcontrollers with a camera that looks straight at the paper. Uses only integer
/// arithmetic. The time per frame is short and bounded. The options `effort` and `decoder` have no
/// effect. Computes neither covariance nor residual. Computes only a fast upper bound on the
/// probability that a position is wrong, and refuses the position as not_certain if this bound
/// exceeds IntegrityOptions::max_p_wrong_log2. A program that uses only this class does not link
/// the desktop attempts.
class DeviceLocator : public RowLocator {
  public:
    /// The rules for memory and options are the same as for Locator.
    explicit DeviceLocator(AnyDeviceMemory& memory, const DeviceOptions& options = {});

    /// Sets the regions of the code plane on the printed sheets that may be in view, as
    /// Locator::set_known does. Searches the regions first, and the other parts of the plane only
    /// if other sheets are possible. Regions in a code other than `options().code` have no effect.
    /// A search needs no additional memory. Its time is proportional to the number of columns and
    /// rows of all regions, so there should be few regions.
    Status set_known(std::span<const KnownRegion> regions,
                     OtherSheets others = OtherSheets::possible);

    /// Returns the pose of an image, in the code of the options.
    Fix locate(const ImageView& image);
    /// Measures the dots of an image at their predicted places. A frame that does not confirm the
    /// prediction is located without the prediction.
    Fix locate(const ImageView& image, const Prediction& prediction);

    /// Starts a frame that is pushed row by row. The dots of each row are detected as the row
    /// arrives. Errors: bad_argument, image_too_small, image_too_large (too large for the memory).
    Status begin(int width_px, int height_px);

    /// Starts a frame whose dots are measured at their predicted places, as the rows arrive.
    /// Returns not_tracked if the prediction cannot be used. If the frame does not confirm the
    /// prediction, the fix of `finish` has the status not_tracked. The caller can then push the
    /// rows again without a prediction, if it still has them.
    Status begin(int width_px, int height_px, const Prediction& prediction);

    /// Processes the next row of `width_px` pixels. The pixels need not remain valid afterwards.
    /// Ignores rows beyond the height of the frame, and all rows if no frame was begun.
    void push_row(const std::uint8_t* pixels);

    /// Locates the frame whose rows were pushed. If `begin` failed, the fix has the status of
    /// `begin`. If `begin` was not called, the status is bad_argument.
    Fix finish();

  private:
    core::DeviceWorkspace& workspace();
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
