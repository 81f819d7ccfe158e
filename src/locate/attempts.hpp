// Attempts: makes individual attempts to locate a frame, each in one code, and judges their fixes.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "core/integrity/possible_codes.hpp"
#include "core/math/readout_turn.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/status.hpp"
#include "locate/frame.hpp"
#include "locate/second.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Attempts without a prediction:
/// - `first` ends without a fix if the fix would be rough and a second attempt is possible (see
///   `Attempts::is_rough`).
/// - `complete_first` is `first`, but never ends early.
/// - `turning` searches for a rotation of the scene during the readout.
/// - `resampled` is `second`, but samples the bits again if the position is doubtful. It takes
///   three times as long as `second`.
/// - `device` locates the frame as a DeviceLocator does.
enum class Step : std::uint8_t { first, complete_first, turning, second, resampled, device };

/// Returns true if, according to the status, the image shows a grid of dots, but their bits do not
/// determine a reliable position in this code. An attempt in another code may succeed.
bool leaves_code_open(Status status);

/// Makes attempts to locate one frame. The results of the last attempt are in the workspace.
class Attempts {
  public:
    Attempts(const ImageView& image, const DeviceOptions& options, const PossibleCodes& codes,
             DesktopWorkspace& w)
        : image_(image), options_(options), codes_(codes), w_(w), second_(w) {}

    /// Makes an attempt near a prediction. Returns true if there is a fix.
    bool track(const Prediction& prediction);
    /// Makes an attempt in one code. Returns true if there is a fix.
    bool make(Step step, CodeVariant code);

    /// Returns the codes in which the step should be tried, starting with the most likely code. If
    /// several codes are possible, returns at most one code for `resampled`: the code with the
    /// fewest bit errors among the codes for which `second` found only a doubtful position.
    std::span<const CodeVariant> codes_for(Step step) const;
    /// Returns true if the options allow a second attempt and the image is large enough for one.
    bool may_try_twice() const;

    /// Judges the fix of the last attempt, which was made in the code `read`. Returns the certainty
    /// of the fix, and the most likely other code with its odds.
    Judgement judge(CodeVariant read) const;
    /// Returns true if a rotation of the scene during the readout may explain the residuals of the
    /// fix. A search for this rotation (`Step::turning`) may then give a better fix. Returns false
    /// if the attempt has already taken too much work (see `WorkLimit`).
    bool shows_turn();
    /// Returns true if the last `Step::first` attempt ended early because its fix would be rough.
    bool is_rough() const { return w_.measurement.is_rough; }
    /// Returns true if the last attempt found that the image shows too few cells for a reliable fix
    /// in any code.
    bool shows_too_few_cells() const { return w_.measurement.shows_too_few_cells; }
    /// Returns true if the last `Step::first` attempt showed that the scene did not rotate during
    /// the readout (see `Measurement::is_still`).
    bool is_still() const { return w_.measurement.is_still; }

  private:
    Frame frame() const { return w_.frame(kernels(), image_, options_); }
    Frame frame_in(CodeVariant code);
    bool make(Step step, const Frame& frame);
    void note_compared_bits();
    bool make_second(const Frame& frame);
    bool make_as_device();

    static constexpr int kMaxErrors = std::numeric_limits<int>::max();

    /// Rotation that the last call of `shows_turn` has fitted, for the next `Step::turning`.
    ReadoutTurn shown_turn_;
    const ImageView& image_;
    DeviceOptions options_;  ///< `code` is the code of the last attempt
    const PossibleCodes& codes_;
    DesktopWorkspace& w_;
    SecondAttempt second_;
    /// The code in which `second` found the doubtful position with the fewest bit errors.
    CodeVariant worth_resampling_ = CodeVariant::anoto;
    int min_errors_ = kMaxErrors;  ///< number of bit errors at this position
};

}  // namespace dotpose::core
