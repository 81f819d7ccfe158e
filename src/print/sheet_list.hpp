/// What must hold for the sheets of a file, taken together.
#pragma once

#include <vector>

#include "dotpose/tools/sheet_file.hpp"

namespace dotpose::print {

/// Throws BadArgument if `entry` itself is wrong, or if one of `sheets`, leaving out `ignored`, has
/// its name or shares cells with it.
void check_beside(const SheetEntry& entry, const std::vector<SheetEntry>& sheets,
                  const SheetEntry* ignored = nullptr);

/// Checks and appends. Throws BadArgument.
void append(const SheetEntry& entry, std::vector<SheetEntry>& sheets);

/// First cell of the next free region; see SheetFile::allocate. Throws BadArgument if there is
/// none.
Cell free_origin(const std::vector<SheetEntry>& sheets, int columns, int rows);

}  // namespace dotpose::print
