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

/// Throws BadArgument for a length that is not above 0, dots that touch, or a section that does not
/// exist.
void validate_pattern(const Pattern& pattern);

/// Throws BadArgument unless `count` rows or columns, which is what messages call them, can be read
/// and lie on the code plane. `first` is the first cell on the axis of this name. The count is a
/// double so that it can be checked before it is made an integer.
void validate_region(const char* what, char axis, std::uint32_t first, double count);

}  // namespace dotpose::base

#pragma GCC visibility pop
