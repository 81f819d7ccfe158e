// Earlier bits: the bits read in earlier frames, arranged in the grid of the newest of these
// frames. A measured motion relates this grid to the current grid. Frames that do not determine a
// reliable position individually may do so together. See docs/integrity.md, "Frames read together".
#pragma once

#include <optional>

#include "core/decode/bit_lines.hpp"
#include "core/math/float_plane.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/measured_motion.hpp"

namespace dotpose::core {

/// Bits from one or more frames, in one grid.
struct FrameBits {
    BitBlock block;
    FloatPlane grid_from_image;  ///< image points are in px relative to the image centre
    int bits = 0;                ///< number of bits in the block
    int frames = 0;              ///< number of frames that contributed bits
};

/// Bits from several frames, in the grid of the current frame.
struct JoinedBits {
    BitBlock block;
    int frames = 0;
    /// log2 of an upper bound on the probability of a wrong grid match.
    int p_mismatch_log2 = 0;
};

class EarlierBits {
  public:
    /// Discards the bits of all frames.
    void clear();
    /// Begins a frame. `motion` is the motion since the previous frame. The options must contain
    /// the spacing.
    void begin_frame(const MeasuredMotion& motion, const DeviceOptions& options);
    /// Ends the frame. Keeps its bits for the following frames, joined with the earlier bits if the
    /// grids match. If the frame has no bits, keeps the earlier bits.
    void end_frame();

    /// Stores a block of bits from the current frame. Must be called between `begin_frame` and
    /// `end_frame`. If several blocks are stored, only one is kept: the last block with a confirmed
    /// place or, if no place is confirmed, the block with the most bits.
    void note(const BitBlock& block, const FloatPlane& grid_from_image, bool is_confirmed);

    /// True while an attempt reads the current frame together with earlier frames.
    bool is_joining = false;
    /// Returns true between `begin_frame` and `end_frame`.
    bool is_in_series() const { return is_in_frame_; }
    bool has_earlier() const { return is_in_frame_ && earlier_.frames > 0; }
    /// Joins a block from the current frame with the earlier bits. Drops cells whose bits differ
    /// between the frames. Returns nullopt if there are no earlier bits, or if the upper bound on
    /// the probability of a wrong grid match exceeds half of the accepted probability of a wrong
    /// fix.
    std::optional<JoinedBits> join(const BitBlock& block, const FloatPlane& grid_from_image) const;

  private:
    bool is_in_frame_ = false;
    bool is_confirmed_ = false;
    FloatVec reference_px_;  ///< reference point, relative to the image centre
    float spacing_mm_ = 0;
    int max_p_mismatch_log2_ = 0;
    MeasuredMotion motion_;  ///< from the frame of `earlier_` to the current frame
    FrameBits earlier_;
    FrameBits current_;
};

}  // namespace dotpose::core
