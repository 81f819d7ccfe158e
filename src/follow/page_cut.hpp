/// Masks the part of a frame that is beyond the edge of a page, where `locate` would take dots of
/// the next sheet for dots of this one.
#pragma once

#include <optional>

#include "dotpose/files/sheet_place.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::follow_detail {

/// Returns the image with everything outside of the page painted over, or none if all of the image
/// shows the page. `fix` and `place` are the results for the image with `options`.
std::optional<GreyImage> cut_to_page(ImageView image, const Options& options, const Fix& fix,
                                     const SheetPlace& place);

/// Returns the image with everything outside of the sheet's dots painted over, such as labels in
/// its margins and the table beside it, or none if all of the image shows dots. `fix` must be on
/// the sheet.
std::optional<GreyImage> cut_to_dots(ImageView image, const Options& options, const Fix& fix,
                                     const Sheet& sheet);

}  // namespace dotpose::follow_detail
