// Anchors: places of the scan where `locate` read the position by itself.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "calibrate/print_map.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/image.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::calibrate {

/// One such place.
struct Anchor {
    int tile = 0;
    LocalMap map;
    Section section;
};

/// Called after each crop.
using CropDone = std::function<void()>;

/// Runs `locate` on crops of a scan.
class CropLocator {
  public:
    /// Without a profile, it is found from all crops.
    CropLocator(const ImageView& scan, std::optional<Profile> profile);

    /// Returns tiles that hold about 24 x 24 cells; none if no crop of any size shows a pattern.
    /// The crops may be magnified, because `locate` needs 6 px from dot to dot.
    std::optional<Tiling> choose_tiling(const CropDone& done);

    /// Locates in every second tile, like the black fields of a chessboard, with some surroundings;
    /// it is quicker to follow the grid into the tiles between than to locate there.
    std::vector<Anchor> find_anchors(const Tiling& tiling, const CropDone& done);

    const CodeReader& code() const { return reader_; }

  private:
    void use_effort(Effort effort);
    double probe_spacing_px(const Tiling& tiling, int step, const CropDone& done);
    std::optional<Anchor> locate_in(const PixelRect& rect);
    ImageView magnified(const PixelRect& rect);

    ImageView scan_;
    CodeReader reader_;
    int zoom_ = 1;
    Locator locator_{Options{}};
    std::vector<std::uint8_t> magnified_;
};

}  // namespace dotpose::calibrate
