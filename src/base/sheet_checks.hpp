/// The checks of `validate(sheet)` one by one, for code that makes sheets.
#pragma once

#include <cstdint>

#include "dotpose/files/sheet.hpp"

// Visible outside of the library because the tools library calls them too.
#pragma GCC visibility push(default)

namespace dotpose::base {

/// Decimal lengths are not exact in binary, so comparisons allow a tenth of a nanometre, which is
/// far below the accuracy of any printer.
inline constexpr double kTolerance_mm = 1e-7;

/// Throws BadArgument unless each side of a page is in (0, kMaxPage_mm].
void validate_paper(double width_mm, double height_mm);

/// Throws BadArgument for lengths of 0 or less, dots that touch, or an invalid section.
void validate_pattern(const Pattern& pattern);

/// Throws BadArgument unless `count` rows or columns (`what`, for messages) are enough to be read
/// and are inside the code plane. `first` is the first cell on the axis. The count is a double
/// because it is checked before the conversion to an integer.
void validate_region(const char* what, char axis, std::uint32_t first, double count);

}  // namespace dotpose::base

#pragma GCC visibility pop
