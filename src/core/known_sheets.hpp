// Known sheets: the parts of the code plane that are printed on the sheets known to a locator.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "dotpose/known_region.hpp"

namespace dotpose::core {

/// Range of positions along one axis at which a block of `lines` adjacent lines overlaps a region.
/// The position of a block is the position of its first line. The region starts at `region_first`
/// and spans `region_size` positions.
struct PositionRange {
    std::uint32_t first;
    std::uint32_t count;

    PositionRange(std::uint32_t region_first, std::uint32_t region_size, int lines) {
        const auto before = static_cast<std::uint32_t>(lines - 1);
        first = region_first < before ? 0 : region_first - before;
        count = region_first + region_size - first;
    }
    bool contains(std::uint32_t position) const { return position - first < count; }
    friend bool operator==(const PositionRange&, const PositionRange&) = default;
};

/// Returns true if a region is not empty, is inside the plane, and has a valid code and section.
inline bool is_valid(const KnownRegion& region) {
    const auto is_in_plane = [](std::uint32_t first, std::uint32_t size) {
        return size > 0 && first < kPositionsPerAxis && size <= kPositionsPerAxis - first;
    };
    return static_cast<int>(region.code) < kCodeVariantCount && region.section.u < kSections &&
           region.section.v < kSections && is_in_plane(region.first.x, region.columns) &&
           is_in_plane(region.first.y, region.rows);
}

/// The known sheets of a locator, and whether other sheets are possible.
struct KnownSheets {
    std::span<const KnownRegion> regions;
    OtherSheets others = OtherSheets::possible;

    bool any() const { return !regions.empty(); }
    bool are_valid() const { return std::all_of(regions.begin(), regions.end(), is_valid); }
    bool are_all() const { return any() && others == OtherSheets::impossible; }
    /// Returns the code of all possible sheets. Returns nullopt if the sheets have several codes,
    /// or if other sheets are possible.
    std::optional<CodeVariant> only_code() const {
        if (!are_all()) return std::nullopt;
        const CodeVariant code = regions.front().code;
        const bool is_only =
            std::all_of(regions.begin(), regions.end(),
                        [code](const KnownRegion& region) { return region.code == code; });
        return is_only ? std::optional(code) : std::nullopt;
    }
    /// Returns true if a block overlaps a known sheet. `corner` is the place of the upper left cell
    /// of the block.
    bool show(CodeVariant code, const Place& corner, int columns, int rows) const {
        for (const KnownRegion& region : regions) {
            if (region.code == code && region.section == corner.section &&
                PositionRange(region.first.x, region.columns, columns).contains(corner.cell.x) &&
                PositionRange(region.first.y, region.rows, rows).contains(corner.cell.y)) {
                return true;
            }
        }
        return false;
    }
};

}  // namespace dotpose::core
