/// Print map: the measured offset of each printed dot from its nominal position, for the pages of a
/// sheet file. `PrintMapping` (tools/print_mapping.hpp) creates a map, and `with_print_map` uses it
/// to correct a fix.
///
///     const PrintMap map = read_print_map("desk.map");
///     require_pages(map, sheets);  // throws Error if the map is for other pages
///
/// The file is binary and little-endian. It contains 5 bytes for each dot: 2 bytes for the offset
/// along each axis, and 1 byte for the number of frames in which the dot was measured
/// (docs/print-map.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet_file.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Offset of a dot from its nominal position, along x and y of the pattern, in units of 2^-14
/// printed spacings. The printed spacing is the nominal spacing times the print scale of the axis.
struct DotOffset {
    std::int16_t x_q14 = 0;
    std::int16_t y_q14 = 0;

    double x() const { return x_q14 / 16384.0; }
    double y() const { return y_q14 / 16384.0; }
};

/// Covariances of the errors of a print map, at the nodes of a grid that spans all dots on the
/// page. The errors vary slowly over the page, so all dots in a view have nearly the same error.
struct MapErrors {
    /// Covariance of the shift along x and y, in spacings, and of the rotation, in rad: the
    /// elements (x, x), (x, y), (y, y), (x, rotation), (y, rotation), (rotation, rotation).
    using Node = std::array<float, 6>;

    int columns = 0;  ///< number of nodes along x: at least 2, or 0 if the errors are unknown
    int rows = 0;     ///< number of nodes along y
    std::vector<Node> nodes;  ///< row by row
};

/// Maximum number of nodes along each axis.
inline constexpr int kMaxErrorNodes = 256;

/// Map of one page. The code variant, section, region and nominal spacing are those of the sheet.
struct MapPage {
    std::string name;  ///< name of the sheet
    CodeVariant code = CodeVariant::anoto;
    Section section;
    Cell origin;
    int columns = 0;
    int rows = 0;
    double spacing_mm = 0;
    std::uint32_t frames = 0;  ///< number of frames from which the map was computed
    /// Standard deviation, per axis, of the measured centre of a dot in one frame, in spacings.
    double noise = 0;
    /// Standard deviation, per axis, of the difference between the offset of a dot and the mean
    /// offset of the surrounding dots, in spacings.
    double jitter = 0;
    /// Offsets of the dots, row by row. A dot that was never seen is assigned the mean offset of
    /// the surrounding dots.
    std::vector<DotOffset> offsets;
    /// Number of frames in which each dot was measured, at most 255.
    std::vector<std::uint8_t> views;
    MapErrors errors;  ///< empty in maps with file version 1

    /// Returns the index of a dot in `offsets` and `views`. Returns nullopt if the dot is not on
    /// the page.
    std::optional<std::size_t> index_of(const Place& place) const {
        const std::uint32_t x = place.cell.x - origin.x;
        const std::uint32_t y = place.cell.y - origin.y;
        if (place.section != section || x >= std::uint32_t(columns) || y >= std::uint32_t(rows))
            return std::nullopt;
        return std::size_t{y} * std::size_t(columns) + x;
    }

    /// Returns the covariance of the map error in a view that is centred at `place`. The error
    /// consists of a shift along x and y, in spacings, and a rotation, in rad. All elements are 0
    /// if the errors are unknown. `with_print_map` adds this covariance to the covariance of the
    /// fix.
    std::array<std::array<double, 3>, 3> error_covariance(const Place& place) const;
};

/// Maps of the pages of a sheet file.
struct PrintMap {
    std::vector<MapPage> pages;
};

/// Returns the map of the page that contains `place` in the code variant `code`, or null if there
/// is no such page. The result points into `map`.
const MapPage* find_page(const PrintMap& map, CodeVariant code, const Place& place);

/// Result of applying a map to a fix.
enum class MapUse : std::uint8_t {
    no_map,  ///< there is no map of the page, or there is no fix
    used,    ///< the fix is corrected by the map
    /// The map contains measurements of fewer than 20 of the dots in view, or of less than 75 % of
    /// them.
    not_covered,
    /// The dots in view contradict the map, for example because the print was moved or replaced.
    contradicted
};

/// Maximum size of a map file, in bytes. The map of an A0 page is about 20 MB.
inline constexpr std::size_t kMaxMapBytes = std::size_t{512} << 20;

/// Parses the contents of a map file. Throws Error if the contents are not a map, are truncated or
/// damaged, or have a newer file version. Files of version 1 do not store `MapPage::errors`, so
/// these vectors are empty.
PrintMap parse_print_map(std::string_view bytes);

/// Reads a map file. Throws Error, with the name of the file, if the file cannot be read or if its
/// contents are not valid (see `parse_print_map`).
PrintMap read_print_map(const std::filesystem::path& path);

/// Returns the contents of a map file. Throws BadArgument in these cases:
/// - The region of a page is not in the code plane, or a number is out of range.
/// - The name of a page is longer than 4096 bytes.
/// - `offsets` or `views` does not contain exactly one element per dot.
/// - `errors` is not a grid of covariances.
std::string print_map_bytes(const PrintMap& map);

/// Throws Error if a page of the map matches none of the sheets. A page matches a sheet if their
/// code variant, section, region and spacing are equal. Their names may differ.
void require_pages(const PrintMap& map, std::span<const SheetEntry> sheets);

}  // namespace dotpose

DOTPOSE_END_EXPORT
