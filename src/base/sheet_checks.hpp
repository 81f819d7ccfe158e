/// The individual checks of `validate(sheet)`, for code that creates sheets.
#pragma once

#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/files/sheet.hpp"

// Exported, because the tools library uses these functions.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::base {

/// Tolerance of comparisons. Decimal lengths are not exact in binary. A tenth of a nanometre is far
/// below the accuracy of any printer.
inline constexpr double kTolerance_mm = 1e-7;

/// Throws BadArgument unless each side of a page is in (0, kMaxPage_mm].
void validate_paper(double width_mm, double height_mm);

/// Throws BadArgument for lengths of 0 or less, touching dots, or an invalid section.
void validate_pattern(const Pattern& pattern);

/// Throws BadArgument unless `count` rows or columns can be read and are inside the code plane.
/// `what` names the rows or columns in messages, and `first` is the first cell on the axis. The
/// count is a double because it is checked before the conversion to an integer.
void validate_region(const char* what, char axis, std::uint32_t first, double count);

}  // namespace dotpose::base

DOTPOSE_END_EXPORT
