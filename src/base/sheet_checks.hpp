/// The individual checks that `validate(sheet)` performs, for code that creates sheets.
#pragma once

#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/files/sheet.hpp"

// These functions are exported because the tools library uses them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::base {

/// Tolerance for comparing lengths, in mm. A tolerance is necessary because decimal lengths have no
/// exact binary representation. A tenth of a nanometre is far below the accuracy of any printer.
inline constexpr double kTolerance_mm = 1e-7;

/// Throws BadArgument unless each side of a page is in (0, kMaxPage_mm].
void validate_paper(double width_mm, double height_mm);

/// Throws BadArgument if a length is not positive, if neighbouring dots could touch, or if the
/// section is invalid.
void validate_pattern(const Pattern& pattern);

/// Checks a range of `count` rows or columns that begins at position `first`. Throws BadArgument if
/// the range is too small for a sheet, or extends beyond the code plane. `what` and `axis` name the
/// rows or columns in the message. `count` is a double because it is checked before it is converted
/// to an integer.
void validate_region(const char* what, char axis, std::uint32_t first, double count);

}  // namespace dotpose::base

DOTPOSE_END_EXPORT
