/// Conversions between Python values and sheets, their entries and patterns.
#pragma once

#include <array>

#include "binding.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose::python {

using Whole = std::array<std::int64_t, 2>;

/// Converts two integers to a cell or section. Throws BadArgument if they are out of range.
Cell cell_of(const Whole& pair);
Section section_of_pair(const Whole& pair);

/// Returns a pattern. Displacement and dot diameter default to a sixth of the spacing.
Pattern pattern_of(const std::string& code, double spacing_mm, const std::optional<double>& dot_mm,
                   const std::optional<double>& displacement_mm, const Whole& section);

/// Converts "auto", "glyphs" or "strokes" to the DotDrawing of that name. Throws BadArgument for
/// any other name.
DotDrawing drawing_named(const std::string& name);

/// A place on a sheet, with a copy of the sheet's entry.
struct SeenPlace {
    SheetPlace place;
    SheetEntry entry;
};
/// Adds a copy of the sheet's entry to the place. Returns nullopt if there is no place.
std::optional<SeenPlace> seen_place(const std::optional<SheetPlace>& place);

/// Returns the covariance as a 3 x 3 array.
py::array_t<double> array_of(const PoseCovariance& covariance);

}  // namespace dotpose::python
