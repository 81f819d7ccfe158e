// Located frames: the dots of each frame as pixels, with their places in the code.
#pragma once

#include <optional>
#include <vector>

#include "dotpose/code_evidence.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/image.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::calibrate {

/// A dot and its intersection.
struct LocatedDot {
    PixelPoint pixel;
    FixedVec step;  ///< intersection, in spacings from the frame's `place`
    Symbol symbol = Symbol::up;
};

/// Returns the dots that `locate` read, as undistorted pixels; steps start at
/// `trace.decoding.place`.
std::vector<LocatedDot> dots_read(const Trace& trace);

/// The dots of one frame.
struct LocatedFrame {
    int index = 0;                  ///< index of the frame
    Place place;                    ///< place where the steps start
    std::vector<LocatedDot> dots;   ///< pixels of the image, distorted
    std::vector<PixelPoint> blobs;  ///< all blobs of a dot's size, in pixels of the image,
                                    ///< distorted
    double dot_width = 0;           ///< width at half depth, in spacings
    double spacing_px = 0;
};

/// Locates frames with a lens that may be known or unknown.
class FrameReader {
  public:
    /// Without a code variant, it is found from the frames.
    explicit FrameReader(std::optional<CodeVariant> code);

    /// Sets the lens, which is known from now on.
    void use_lens(const FixedLens& lens) {
        lens_ = lens;
        is_known_ = true;
    }
    /// Returns the code variant of the frames, as far as it is known.
    CodeVariant code() const { return reader_.code(); }
    /// Locates a frame; none if it cannot be located.
    std::optional<LocatedFrame> read(const ImageView& image);
    /// Returns what the stages left of the newest frame, with its fix.
    Trace trace() const { return locator_.trace(); }

  private:
    bool locate_with(const ImageView& image, const FixedLens& lens);
    LocatedFrame read_trace(const ImageView& image) const;

    CodeReader reader_;
    FixedLens lens_;
    bool is_known_ = false;
    Locator locator_{Options{}};
};

}  // namespace dotpose::calibrate
