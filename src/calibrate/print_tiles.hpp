// Runs `locate` on the tiles of a scan.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "calibrate/print_dots.hpp"
#include "calibrate/print_map.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/image.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::calibrate {

struct LocatedTile {
    int tile = 0;
    TileMap map;
    Section section;
    PrintLevels levels;  ///< measured around the dots that were read
};

/// All tiles with a fix, in ascending order of their numbers.
struct LocatedTiles {
    Tiling tiling;
    std::vector<LocatedTile> located;
};

/// Called after each call to `locate`.
using TileDone = std::function<void()>;

/// Runs `locate` on the whole scan and on its tiles.
class TileLocator {
  public:
    /// If `code` is empty, the code variant is detected from all located images.
    TileLocator(const ImageView& scan, std::optional<CodeVariant> code, TileDone done);

    /// Locates all tiles. A tile has about 24 x 24 cells and is located together with a margin
    /// around it. If the whole scan has a fix but none of its tiles does, returns the scan as a
    /// single tile. Returns an empty optional if the pattern is found neither in the whole scan nor
    /// in any of the searched crops.
    std::optional<LocatedTiles> locate();

    /// Locates a sample of the tiles again, without assuming a code. Returns the evidence for each
    /// code.
    CodeReader read_without_code(const LocatedTiles& tiles);

    const CodeReader& code() const { return reader_; }
    /// Returns true if a crop shows the mirrored pattern.
    bool is_mirrored() const { return is_mirrored_; }

  private:
    void use_effort(Effort effort);
    std::optional<LocatedTile> locate_whole();
    double find_spacing_px();
    double probe_spacing_px(const Tiling& tiling, int step);
    std::optional<LocatedTile> locate_in(const PixelRect& rect);
    ImageView magnified(const PixelRect& rect);

    ImageView scan_;
    CodeReader reader_;
    TileDone done_;
    bool is_mirrored_ = false;
    int zoom_ = 1;
    Locator locator_{DeviceOptions{}};
    std::vector<std::uint8_t> magnified_;
};

}  // namespace dotpose::calibrate
