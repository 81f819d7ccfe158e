#include "pdf_page_frame.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "pdf_dots.hpp"

namespace dotpose::print {
namespace {

using Rectangle = QPDFObjectHandle::Rectangle;

Rectangle rectangle(QPDFObjectHandle box) {
    if (!box.isRectangle()) throw Error("it has no page size");
    const Rectangle given = box.getArrayAsRectangle();
    return {std::min(given.llx, given.urx), std::min(given.lly, given.ury),
            std::max(given.llx, given.urx), std::max(given.lly, given.ury)};
}

/// Returns the part of the page that viewers show: the intersection of the crop box and the media
/// box.
Rectangle shown_box(QPDFPageObjectHelper& page) {
    const Rectangle media = rectangle(page.getMediaBox());
    const Rectangle crop = rectangle(page.getCropBox());
    return {std::max(crop.llx, media.llx), std::max(crop.lly, media.lly),
            std::min(crop.urx, media.urx), std::min(crop.ury, media.ury)};
}

double user_unit(QPDFPageObjectHelper& page) {
    QPDFObjectHandle unit = page.getObjectHandle().getKey("/UserUnit");
    return unit.isNumber() && unit.getNumericValue() > 0 ? unit.getNumericValue() : 1;
}

int quarter_turns(QPDFPageObjectHelper& page) {
    QPDFObjectHandle rotate = page.getAttribute("/Rotate", false);
    if (!rotate.isNumber()) return 0;
    // A rotation may be stored as an integer or a real number.
    const double degrees = rotate.getNumericValue();
    const double turns = std::fmod(degrees / 90, 4);
    if (turns != std::floor(turns)) {
        throw Error(
            fmt::format("it is turned by {:g} degrees; only quarter turns are known", degrees));
    }
    return (static_cast<int>(turns) + 4) % 4;
}

}  // namespace

PageFrame page_frame(QPDFPageObjectHelper page) {
    const Rectangle box = shown_box(page);
    const double width = box.urx - box.llx;
    const double height = box.ury - box.lly;
    if (!(width > 0 && height > 0)) throw Error("it has no page size");
    const double unit = user_unit(page);
    const double scale = 1 / unit;
    const int turns = quarter_turns(page);
    PageFrame frame;
    frame.box = box;
    frame.paper.width_mm = (turns % 2 == 0 ? width : height) * unit / kPointsPerMm;
    frame.paper.height_mm = (turns % 2 == 0 ? height : width) * unit / kPointsPerMm;
    // Rotation matrices for 0 to 3 quarter turns. Pages are displayed rotated clockwise (ISO
    // 32000-1, 8.3.3).
    constexpr int kTurned[4][4] = {{1, 0, 0, 1}, {0, 1, -1, 0}, {-1, 0, 0, -1}, {0, -1, 1, 0}};
    const auto& [a, b, c, d] = kTurned[turns];
    const double x = turns == 1 || turns == 2 ? box.urx : box.llx;
    const double y = turns == 2 || turns == 3 ? box.ury : box.lly;
    frame.matrix = fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.6f} {:.6f}", a * scale, b * scale,
                               c * scale, d * scale, x, y);
    return frame;
}

void write_turn_as_integer(QPDFPageObjectHelper page) {
    if (!page.getAttribute("/Rotate", false).isReal()) return;
    page.getObjectHandle().replaceKey("/Rotate",
                                      QPDFObjectHandle::newInteger(90 * quarter_turns(page)));
}

}  // namespace dotpose::print
