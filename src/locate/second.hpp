// Second attempt: locates noisy, dirty or unevenly lit images. Filters the image, fits the grid to
// all dots, and reads the bits of each cell.
#pragma once

#include "core/decode/nominal.hpp"
#include "core/pose/refine_pose.hpp"
#include "locate/frame.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Runs the second attempt on one image, once for each of several codes. The filtered image, its
/// dots and its grid do not depend on the code. They are computed once, and are recomputed only if
/// an attempt has overwritten them.
class SecondAttempt {
  public:
    enum class Resampling : std::uint8_t { never, if_doubtful };

    explicit SecondAttempt(DesktopWorkspace& w) : w_(w) {}

    /// Locates the frame in the code `frame.options.code`. All calls must pass the same image. If
    /// there is a fix, stores it in the workspace and returns true. Otherwise, stores the status
    /// and returns false. If the position is not certain and `resampling` is `if_doubtful`, fits
    /// the grid to the dots that the code predicts at this position, and reads and decodes the bits
    /// again.
    bool read(const Frame& frame, Resampling resampling);

  private:
    Status read_filtered(const Frame& frame);
    Status read_filtered_with(const DeviceOptions& filtered, const ImageView& image);
    Status find_grid(const LatticeOptions& options, FixedVec centre_q8);
    Status read_position(const PlaceEvidence& evidence);
    Status resample(const Frame& frame, const PlaceEvidence& evidence);
    Status measure_pose(const Frame& frame);
    bool fit_pattern(const Frame& frame, const Nominal& nominal, PoseFit& fit);

    DesktopWorkspace& w_;
    /// True if the workspace contains the dots and cells of the filtered image.
    bool is_seen_ = false;
    Fix seen_;  ///< copy of the fix, made after reading the bits and before decoding
};

}  // namespace dotpose::core
