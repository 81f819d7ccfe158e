/// Masks the part of a frame that is outside a page. Without the mask, `locate` might combine the
/// dots of the page with those of an adjacent sheet.
#pragma once

#include <optional>

#include "dotpose/device_options.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::follow_detail {

/// Returns a copy of the image in which everything outside the page is masked. Returns an empty
/// optional if the image shows only the page. `fix` and `place` are the results of locating the
/// image with `options`.
std::optional<GreyImage> cut_to_page(ImageView image, const DeviceOptions& options, const Fix& fix,
                                     const SheetPlace& place);

/// Returns a copy of the image in which everything except the dots of the sheet is masked. This
/// removes, for example, labels in the margins and the tabletop around the sheet. Returns an empty
/// optional if nothing needs to be masked. `fix` must be on the sheet.
std::optional<GreyImage> cut_to_dots(ImageView image, const DeviceOptions& options, const Fix& fix,
                                     const Sheet& sheet);

}  // namespace dotpose::follow_detail
