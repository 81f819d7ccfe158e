/// Checks that the names and cells of all sheets in a file are unique.
#pragma once

#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::files {

/// Throws BadArgument if `entry` is invalid, or if its name or one of its cells is already used in
/// `sheets`. Skips the element of `sheets` that `ignored` points to, if any.
void check_beside(const SheetEntry& entry, const std::vector<SheetEntry>& sheets,
                  const SheetEntry* ignored = nullptr);

/// Appends `entry` to `sheets`. Throws BadArgument if `entry` is invalid, or if its name or one of
/// its cells is already used.
void append(const SheetEntry& entry, std::vector<SheetEntry>& sheets);

/// Returns the top left cell of a free region of the given size. Chooses the region as
/// SheetFile::allocate does. Throws BadArgument if there is no free region.
Cell free_origin(const std::vector<SheetEntry>& sheets, int columns, int rows);

}  // namespace dotpose::files
