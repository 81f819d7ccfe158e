// Print tiles: what `locate` reads in the tiles of a scan.
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

/// A tile that was located.
struct LocatedTile {
    int tile = 0;
    TileMap map;
    Section section;
    PrintLevels levels;  ///< of the dots that were read
};

/// The tiles that were located, in order.
struct LocatedTiles {
    Tiling tiling;
    std::vector<LocatedTile> located;
};

/// Called after each call of `locate`.
using TileDone = std::function<void()>;

/// Runs `locate` on a scan as a whole and on tiles of it.
class TileLocator {
  public:
    /// Without a code variant, it is found from all that is located.
    TileLocator(const ImageView& scan, std::optional<CodeVariant> code, TileDone done);

    /// Locates all tiles of about 24 x 24 cells, each with some of its surroundings. Returns none
    /// if neither the scan as a whole nor a crop of any size shows a pattern.
    std::optional<LocatedTiles> locate();

    /// Locates some of the tiles again as if the code were not known, and returns what they say of
    /// it.
    CodeReader read_without_code(const LocatedTiles& tiles);

    const CodeReader& code() const { return reader_; }
    /// Whether a crop shows the pattern as in a mirror.
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
    Locator locator_{Options{}};
    std::vector<std::uint8_t> magnified_;
};

}  // namespace dotpose::calibrate
