// Known sheets: the regions of the code plane that may be in view.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/known_region.hpp"

namespace dotpose::core {

/// Number of positions, along one axis, at which the first of `lines` adjacent lines can be if one
/// of them is on a region. `first` and `size` are those of the region along the axis.
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

/// The sheets that a locator knows.
struct KnownSheets {
    std::span<const KnownRegion> regions;
    OtherSheets others = OtherSheets::possible;

    bool any() const { return !regions.empty(); }
    bool are_all() const { return any() && others == OtherSheets::impossible; }
    /// Returns true if a block of cells is on a known sheet, at least in part. `corner` is the
    /// place of its upper left cell.
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
