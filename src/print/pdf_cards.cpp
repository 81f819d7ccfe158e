#include "pdf_cards.hpp"

#include <cmath>
#include <set>

#include <fmt/core.h>
#include <qpdf/QPDFPageDocumentHelper.hh>

#include "geometry.hpp"
#include "pdf_dots.hpp"
#include "pdf_page_frame.hpp"

namespace dotpose::print {
namespace {

constexpr double kMarkGap_mm = 1;  // distance between the cards and a cut mark
constexpr double kMark_mm = 4;     // length of a cut mark
constexpr double kMargin_mm = kMarkGap_mm + kMark_mm;
constexpr double kMarkWidth_mm = 0.1;

CardGrid grid_on(Paper paper, Paper card) {
    // Tolerance for lengths that were rounded to points. For example, ten cards of 21 mm must fit
    // into 210 mm.
    constexpr double kTolerance_mm = 0.01;
    const auto fit = [](double paper_mm, double card_mm) {
        return static_cast<int>((paper_mm - 2 * kMargin_mm + kTolerance_mm) / card_mm);
    };
    CardGrid grid{.paper = paper, .card = card};
    grid.columns = fit(paper.width_mm, card.width_mm);
    grid.rows = fit(paper.height_mm, card.height_mm);
    grid.left_mm = (paper.width_mm - grid.columns * card.width_mm) / 2;
    grid.top_mm = (paper.height_mm - grid.rows * card.height_mm) / 2;
    return grid;
}

/// Position of the top left corner of a card on the page.
struct Corner {
    double x_mm = 0;
    double y_mm = 0;
};

Corner corner_of(const CardGrid& grid, int slot) {
    constexpr double kPixel_mm = kInch_mm / 300;
    const auto snapped = [](double mm) { return std::round(mm / kPixel_mm) * kPixel_mm; };
    const int column = slot % grid.columns;
    const int row = slot / grid.columns;
    return {snapped(grid.left_mm + column * grid.card.width_mm),
            snapped(grid.top_mm + row * grid.card.height_mm)};
}

}  // namespace

CardGrid card_grid(Paper paper, Paper card) {
    const CardGrid upright = grid_on(paper, card);
    const CardGrid turned = grid_on({paper.height_mm, paper.width_mm}, card);
    const CardGrid& best = turned.cards() > upright.cards() ? turned : upright;
    if (best.columns > 0 && best.rows > 0) return best;
    throw BadArgument(fmt::format(
        "a card of {:.1f} x {:.1f} mm does not fit on paper of {:g} x {:g} mm with {:g} mm for cut "
        "marks on each side",
        card.width_mm, card.height_mm, paper.width_mm, paper.height_mm, kMargin_mm));
}

Sheet on_page(const CardGrid& grid, int slot, Sheet card) {
    card.width_mm = grid.paper.width_mm;
    card.height_mm = grid.paper.height_mm;
    const Corner corner = corner_of(grid, slot);
    card.origin_x_mm += corner.x_mm;
    card.origin_y_mm += corner.y_mm;
    return card;
}

std::string cut_marks(const CardGrid& grid) {
    std::string content = fmt::format("q 0 0 0 1 K {:.3f} w\n", kMarkWidth_mm * kPointsPerMm);
    const auto line = [&](double x_mm, double y_mm, double to_x_mm, double to_y_mm) {
        const auto y_pt = [&](double y) { return (grid.paper.height_mm - y) * kPointsPerMm; };
        content += fmt::format("{:.3f} {:.3f} m {:.3f} {:.3f} l S\n", x_mm * kPointsPerMm,
                               y_pt(y_mm), to_x_mm * kPointsPerMm, y_pt(to_y_mm));
    };
    const double right_mm = grid.left_mm + grid.columns * grid.card.width_mm;
    const double bottom_mm = grid.top_mm + grid.rows * grid.card.height_mm;
    for (int i = 0; i <= grid.columns; ++i) {
        const double x_mm = grid.left_mm + i * grid.card.width_mm;
        line(x_mm, grid.top_mm - kMargin_mm, x_mm, grid.top_mm - kMarkGap_mm);
        line(x_mm, bottom_mm + kMarkGap_mm, x_mm, bottom_mm + kMargin_mm);
    }
    for (int j = 0; j <= grid.rows; ++j) {
        const double y_mm = grid.top_mm + j * grid.card.height_mm;
        line(grid.left_mm - kMargin_mm, y_mm, grid.left_mm - kMarkGap_mm, y_mm);
        line(right_mm + kMarkGap_mm, y_mm, right_mm + kMargin_mm, y_mm);
    }
    return content + "Q\n";
}

QPDFObjectHandle card_form(QPDFPageObjectHelper page) {
    // qpdf clips the form to the trim box, which may be smaller than the displayed page. The trim
    // box is therefore set to the displayed page.
    page.getObjectHandle().replaceKey("/TrimBox", QPDFObjectHandle::newArray(page_frame(page).box));
    return page.getFormXObjectForPage(true);
}

std::string place_card(QPDFPageObjectHelper page, const CardGrid& grid, int slot,
                       const QPDFObjectHandle& form, const std::string& name) {
    const Corner corner = corner_of(grid, slot);
    const double x = corner.x_mm * kPointsPerMm;
    const double top = (grid.paper.height_mm - corner.y_mm) * kPointsPerMm;
    return page.placeFormXObject(
        form, name,
        {x, top - grid.card.height_mm * kPointsPerMm, x + grid.card.width_mm * kPointsPerMm, top},
        false, true, true);
}

QPDFPageObjectHelper add_card_page(QPDF& pdf, const CardGrid& grid) {
    const QPDFPageObjectHelper page(pdf.makeIndirectObject(QPDFObjectHandle::parse(
        fmt::format("<< /Type /Page /MediaBox [0 0 {:.4f} {:.4f}] >>",
                    grid.paper.width_mm * kPointsPerMm, grid.paper.height_mm * kPointsPerMm))));
    QPDFPageDocumentHelper document(pdf);
    document.addPage(page, false);
    return document.getAllPages().back();
}

void remove_pages(QPDF& pdf) {
    const std::set<std::string> kept = {"/Type", "/Pages",    "/Version",       "/OCProperties",
                                        "/Lang", "/Metadata", "/OutputIntents", "/Extensions"};
    QPDFPageDocumentHelper document(pdf);
    for (const QPDFPageObjectHelper& page : document.getAllPages())
        document.removePage(page);
    QPDFObjectHandle root = pdf.getRoot();
    for (const std::string& key : root.getKeys()) {
        if (!kept.contains(key)) root.removeKey(key);
    }
}

}  // namespace dotpose::print
