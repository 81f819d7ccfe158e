/// Frames that show the edge of a page: what lies beyond it is kept from `locate`, which would take
/// dots of the sheet beside for those of this one.
#pragma once

#include <optional>

#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/sheet_file.hpp"

namespace dotpose::cli {

/// The image with all that is not on the page painted over. `fix` and `place` are what was found in
/// the image with `options`. None if the image shows nothing but the page.
std::optional<GreyImage> cut_to_page(ImageView image, const Options& options, const Fix& fix,
                                     const SheetPlace& place);

/// The image with all painted over that is not among the dots of the sheet: labels in its margins,
/// the table beside it. `fix` lies on the sheet. None if the image shows nothing but the dots.
std::optional<GreyImage> cut_to_dots(ImageView image, const Options& options, const Fix& fix,
                                     const Sheet& sheet);

}  // namespace dotpose::cli
