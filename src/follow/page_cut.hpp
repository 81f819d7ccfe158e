/// Masks the part of a frame beyond the edge of a page. Without the mask, `locate` would combine
/// the dots of an adjacent sheet with the dots of this sheet.
#pragma once

#include <optional>

#include "dotpose/device_options.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::follow_detail {

/// Returns the image with everything outside the page masked, or an empty optional if the whole
/// image shows the page. `fix` and `place` are the results of locating the image with `options`.
std::optional<GreyImage> cut_to_page(ImageView image, const DeviceOptions& options, const Fix& fix,
                                     const SheetPlace& place);

/// Returns the image with everything outside the dots of the sheet masked, such as labels in the
/// margins and the table beside the sheet. Returns an empty optional if the whole image shows dots.
/// `fix` must be on the sheet.
std::optional<GreyImage> cut_to_dots(ImageView image, const DeviceOptions& options, const Fix& fix,
                                     const Sheet& sheet);

}  // namespace dotpose::follow_detail
