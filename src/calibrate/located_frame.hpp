// The dots in each located frame, with their pixel coordinates and their places in the code.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/image.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::calibrate {

/// Returns the number of steps from one cell to another along an axis of the cyclic code plane, in
/// the shorter direction.
inline double steps(std::uint32_t from, std::uint32_t to) {
    return std::remainder(double(to) - double(from), double(kPositionsPerAxis));
}

/// A measured dot and its intersection.
struct LocatedDot {
    PixelPoint pixel;
    FixedVec step;  ///< intersection, in spacings from `LocatedFrame::place`
    Symbol symbol = Symbol::up;
};

/// Returns the dots that `locate` read. Pixel coordinates are undistorted. Steps are relative to
/// `trace.decoding.place`.
std::vector<LocatedDot> dots_read(const Trace& trace);

/// Dots in one frame. Pixel coordinates are not corrected for distortion.
struct LocatedFrame {
    int index = 0;                  ///< index of the frame in the series
    Place place;                    ///< place in the code where `step` is (0, 0)
    std::vector<LocatedDot> dots;   ///< dots that belong to the pattern
    std::vector<PixelPoint> blobs;  ///< all dot-sized blobs
    double dot_width = 0;  ///< full width of the dots at half maximum darkness, in spacings
    double spacing_px = 0;
};

/// Locates frames. If the lens is unknown, tries several lenses.
class FrameReader {
  public:
    /// If `code` is an empty optional, the reader detects the code variant from the frames.
    explicit FrameReader(std::optional<CodeVariant> code);

    /// Sets the lens for all following frames. The reader tries no other lens afterwards.
    void use_lens(const FixedLens& lens) {
        lens_ = lens;
        is_known_ = true;
    }
    /// Returns the code variant that was given, or the most probable variant so far.
    CodeVariant code() const { return reader_.code(); }
    /// Locates a frame. Returns an empty optional if there is no fix.
    std::optional<LocatedFrame> read(const ImageView& image);
    /// Returns the results of all stages of `locate` for the latest frame, including its fix.
    Trace trace() const { return locator_.trace(); }

  private:
    bool locate_with(const ImageView& image, const FixedLens& lens);
    LocatedFrame read_trace(const ImageView& image) const;

    CodeReader reader_;
    FixedLens lens_;
    bool is_known_ = false;
    Locator locator_{DeviceOptions{}};
};

}  // namespace dotpose::calibrate
