// Located frames: the dots of each as pixels, with the places where the code has them printed.
#pragma once

#include <optional>
#include <vector>

#include "dotpose/code_evidence.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/heap_locator.hpp"

namespace dotpose::calibrate {

struct LocatedDot {
    PixelPoint pixel;
    Vec step;  ///< its intersection, in spacings from the frame's `place`
    Symbol symbol = Symbol::up;
};

/// The dots that `locate` read, as undistorted pixels; they start at `trace.decoding.place`.
std::vector<LocatedDot> dots_read(const Trace& trace);

struct LocatedFrame {
    int index = 0;                  ///< of the frame
    Place place;                    ///< where the steps start
    std::vector<LocatedDot> dots;   ///< pixels in the image as it is, distorted
    std::vector<PixelPoint> blobs;  ///< all that look like dots, in the image as it is
    double dot_width = 0;           ///< at half depth, in spacings
    double spacing_px = 0;
};

/// Locates frames with a lens that may be known or not.
class FrameReader {
  public:
    /// Without a profile, it is found out from the frames.
    explicit FrameReader(std::optional<Profile> profile);

    /// From now on the lens is known.
    void use_lens(const Lens& lens) {
        lens_ = lens;
        is_known_ = true;
    }
    /// That of the frames, as far as is known by now.
    Profile profile() const { return reader_.code(); }
    /// Nothing if the frame cannot be located.
    std::optional<LocatedFrame> read(const ImageView& image);

  private:
    bool locate_with(const ImageView& image, const Lens& lens);
    LocatedFrame read_trace(const ImageView& image) const;

    CodeReader reader_;
    Lens lens_;
    bool is_known_ = false;
    HeapLocator locator_;
};

}  // namespace dotpose::calibrate
