/// Known regions: the rectangles of the code plane that are printed on known sheets. With known
/// regions, a Locator also locates views that are too small to be unique on the whole plane.
///
///     static constexpr KnownRegion kSheets[] = {
///         {.first = {1024, 1024}, .columns = 393, .rows = 563}};
///     locator.set_known(kSheets, OtherSheets::impossible);
#pragma once

#include <cstdint>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// A rectangle of the code plane that is printed on a sheet.
struct KnownRegion {
    CodeVariant code = CodeVariant::anoto;
    Section section;
    Cell first;  ///< upper left intersection
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
};

/// Minimum number of dots required to search for a grid if regions are known. A lower `min_dots` in
/// the options takes precedence. In practice, a reliable position needs about 25 dots.
inline constexpr int kMinKnownDots = 16;

/// Specifies whether sheets other than the known sheets may be in view.
enum class OtherSheets : std::uint8_t {
    possible,    ///< other sheets are also located, but require more dots in view
    impossible,  ///< only places on known sheets are possible
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
