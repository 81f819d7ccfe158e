#include "pdf_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/core.h>
#include <qpdf/QPDFObjectHandle.hh>
#include <qpdf/QUtil.hh>

#include "base/printable.hpp"
#include "geometry.hpp"
#include "pdf_dots.hpp"

namespace dotpose::print {
namespace {

constexpr double kGap_mm = 0.8;   // distance between the ink of the pattern and a label
constexpr double kEdge_mm = 0.3;  // distance between a label and the edge of the page
constexpr double kText_pt = 6;
constexpr double kLine_mm = 2.5;
constexpr std::size_t kMaxNameCharacters = 60;

constexpr double kNumber_pt = 4.5;
// Height of a digit in Helvetica.
constexpr double kNumberHeight_mm = 0.718 * kNumber_pt / kPointsPerMm;
constexpr double kLongTick_mm = 1.8;
constexpr double kNumberAway_mm = kGap_mm + kLongTick_mm + 0.3;
constexpr double kRulerRoom_mm = kNumberAway_mm + kNumberHeight_mm + kEdge_mm;

// Distance between the numbers of a ruler and the arrow beside them.
constexpr double kArrowGap_mm = 0.9;
constexpr double kArrow_mm = 6;  // length by which an arrow extends beyond the other arrow
constexpr double kArrowHead_mm = 1.3;
constexpr double kNoteAway_mm = 3;  // distance from the x arrow to the note

// Widths of the characters from the space to '~', in thousandths of the font size (Adobe font
// metrics for Helvetica).
constexpr std::array<int, 95> kHelveticaWidths = {
    278,  278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,  //
    556,  556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,  //
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,  //
    667,  778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,  //
    333,  556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,  //
    556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};
constexpr int kWidestAccented = 1000;

double width_mm(const std::string& text, double size_pt) {
    int thousandths = 0;
    for (const char c : text) {
        const auto index = static_cast<std::size_t>(static_cast<unsigned char>(c) - 32);
        thousandths += index < kHelveticaWidths.size() ? kHelveticaWidths[index] : kWidestAccented;
    }
    return thousandths * size_pt / 1000 / kPointsPerMm;
}

/// Returns the number of bytes of the UTF-8 character that begins with the byte `first`.
std::size_t length_of(char first) {
    const auto byte = static_cast<unsigned char>(first);
    return byte < 0xC0 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// Returns the first `max_characters` characters of a UTF-8 string.
std::string beginning(const std::string& utf8, std::size_t max_characters) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < max_characters && end < utf8.size(); ++i)
        end += length_of(utf8[end]);
    return utf8.substr(0, end);
}

/// Returns the text encoded for Helvetica, or nullopt if Helvetica lacks a letter of the text and a
/// different font is available. If no other font is available, missing letters become question
/// marks.
std::optional<std::string> in_helvetica(const std::string& utf8) {
    std::string text;
    const bool has_all_letters = QUtil::utf8_to_win_ansi(utf8, text, '?');
    if (has_all_letters || !ScriptText::is_available()) return text;
    return std::nullopt;
}

/// Breaks text into lines for which `fits` returns true. Lines end between words, but a word that
/// is wider than a line is split.
template <typename Fits>
std::vector<std::string> wrap(const std::string& text, const Fits& fits) {
    std::vector<std::string> lines = {""};
    const auto add_word = [&](const std::string& word) {
        std::string& line = lines.back();
        const std::string longer = line.empty() ? word : line + " " + word;
        if (fits(longer)) {
            line = longer;
            return;
        }
        if (!line.empty()) lines.emplace_back();
        for (std::size_t i = 0; i < word.size();) {
            const std::string letter = word.substr(i, length_of(word[i]));
            if (!lines.back().empty() && !fits(lines.back() + letter)) lines.emplace_back();
            lines.back() += letter;
            i += letter.size();
        }
    };
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        add_word(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

/// Sides of the dot area along which a ruler can be placed.
enum class Side { top, left };
double free_margin_mm(const Sheet& sheet, Side side) {
    return (side == Side::top ? sheet.origin_y_mm : sheet.origin_x_mm) - reach_mm(sheet.pattern);
}

bool has_ruler(const Sheet& sheet, Side side) {
    return free_margin_mm(sheet, side) >= kRulerRoom_mm;
}

/// Positions of the x arrow and the y arrow of the page. Both arrows are farther from the dots than
/// the rulers are.
struct Arrows {
    double x_of_y_arrow_mm = 0;
    double y_of_x_arrow_mm = 0;
    double x_end_mm() const { return x_of_y_arrow_mm + kArrow_mm; }
    double y_end_mm() const { return y_of_x_arrow_mm + kArrow_mm; }
};

/// Returns the positions of the arrows, or an empty optional if a margin is too narrow for an arrow
/// beside the ruler.
std::optional<Arrows> arrows_of(const Sheet& sheet) {
    const double x_mm = free_margin_mm(sheet, Side::left) - kRulerRoom_mm - kArrowGap_mm;
    const double y_mm = free_margin_mm(sheet, Side::top) - kRulerRoom_mm - kArrowGap_mm;
    if (std::min(x_mm, y_mm) < kNumberHeight_mm / 2 + kEdge_mm) return std::nullopt;
    return Arrows{x_mm, y_mm};
}

/// Returns the pattern coordinates of the top left corner of the page, which is the origin of the
/// sheet's coordinate frame.
std::string corner_text(const Sheet& sheet) {
    const double spacing_mm = sheet.pattern.spacing_mm;
    return fmt::format("x_mm {:.3f}, y_mm {:.3f}", sheet.origin.x * spacing_mm - sheet.origin_x_mm,
                       sheet.origin.y * spacing_mm - sheet.origin_y_mm);
}

std::string corner_note(const Sheet& sheet) {
    return "x_sheet_mm and y_sheet_mm count from this corner, in the pattern " + corner_text(sheet);
}

bool has_note_at_origin(const Sheet& sheet) {
    const auto arrows = arrows_of(sheet);
    return arrows && arrows->x_end_mm() + kNoteAway_mm + width_mm(corner_note(sheet), kNumber_pt) +
                             kEdge_mm <=
                         sheet.width_mm;
}

std::string description(const Sheet& sheet, PageNumber page, const PrintOptions& options) {
    const Pattern& pattern = sheet.pattern;
    std::string text = beginning(options.name, kMaxNameCharacters);
    if (!text.empty()) text += ", ";
    return text + fmt::format(
                      "page {} of {}, cells {},{} to {},{}, section {},{}, spacing {:.6g} mm, for "
                      "{:g} dpi, print at 100 %",
                      page.number, page.count, sheet.origin.x, sheet.origin.y,
                      sheet.origin.x + static_cast<std::uint32_t>(sheet.columns - 1),
                      sheet.origin.y + static_cast<std::uint32_t>(sheet.rows - 1),
                      pattern.section.u, pattern.section.v, pattern.spacing_mm, options.dpi);
}

std::string shown(const std::string& win_ansi) {
    return QPDFObjectHandle::newString(win_ansi).unparse();
}

/// Returns the text below the dots as PDF content. The first line is closest to the dots.
std::string text_content(const Sheet& sheet, PageNumber page, const PrintOptions& options,
                         ScriptText& script) {
    const double reach = reach_mm(sheet.pattern);
    const double ink_end_mm = dot_y_mm(sheet, sheet.rows - 1, 0) + reach;
    const double room_mm = sheet.height_mm - ink_end_mm - kGap_mm - kEdge_mm;
    const auto max_lines = static_cast<std::size_t>(std::max(0.0, room_mm / kLine_mm));
    const double widest_mm = (sheet.columns - 1) * sheet.pattern.spacing_mm + 2 * reach;

    const auto fits = [&](const std::string& utf8) {
        const auto plain = in_helvetica(utf8);
        return (plain ? width_mm(*plain, kText_pt)
                      : script.width_pt(utf8, kText_pt) / kPointsPerMm) <= widest_mm;
    };
    std::string text = description(sheet, page, options);
    if (!has_note_at_origin(sheet)) {
        text += ", top left corner at " + corner_text(sheet);
    }
    std::vector<std::string> lines = wrap(base::printable(text), fits);
    const std::vector<std::string> command = wrap(base::printable(options.command), fits);
    // The command is printed only if it fits completely, because an incomplete command would print
    // a different sheet.
    if (!options.command.empty() && lines.size() + command.size() <= max_lines) {
        lines.insert(lines.end(), command.begin(), command.end());
    }
    lines.resize(std::min(lines.size(), max_lines));

    std::string content = fmt::format("BT /Label {} Tf\n", kText_pt);
    std::string forms;
    double bottom_mm = sheet.height_mm - ink_end_mm - kGap_mm;
    for (const std::string& line : lines) {
        bottom_mm -= kLine_mm;
        const double x_pt = (sheet.origin_x_mm - reach) * kPointsPerMm;
        // A quarter of the line height below the baseline is left for descenders.
        const double y_pt = (bottom_mm + kLine_mm / 4) * kPointsPerMm;
        if (const auto plain = in_helvetica(line)) {
            fmt::format_to(std::back_inserter(content), "1 0 0 1 {:.3f} {:.3f} Tm {} Tj\n", x_pt,
                           y_pt, shown(*plain));
        } else {
            forms += script.draw(line, kText_pt, x_pt, y_pt);
        }
    }
    return content + "ET\n" + forms;
}

/// Returns a point on the page as PDF operands.
std::string point(const Sheet& sheet, double x_mm, double y_mm) {
    return fmt::format("{:.3f} {:.3f}", x_mm * kPointsPerMm,
                       (sheet.height_mm - y_mm) * kPointsPerMm);
}

/// Returns the PDF content of a ruler. The ruler begins with 0 at the edge of the paper and ends at
/// the last intersection. It has a tick every millimetre and a number every ten millimetres. Ticks
/// that would cross the other ruler or its arrow are omitted.
std::string ruler_content(const Sheet& sheet, Side side) {
    if (!has_ruler(sheet, side)) return {};
    const bool is_top = side == Side::top;
    const double away_from_mm = free_margin_mm(sheet, side);
    // Returns the point on the page that is `along_mm` along the ruler and `away_mm` away from the
    // dots. The left ruler runs downwards.
    const auto at = [&](double along_mm, double away_mm) {
        return is_top ? point(sheet, along_mm, away_from_mm - away_mm)
                      : point(sheet, away_from_mm - away_mm, along_mm);
    };
    const Side other = is_top ? Side::left : Side::top;
    const auto arrows = arrows_of(sheet);
    double crossing_mm = has_ruler(sheet, other) ? free_margin_mm(sheet, other) - kRulerRoom_mm : 0;
    if (arrows) {
        crossing_mm =
            (is_top ? arrows->x_of_y_arrow_mm : arrows->y_of_x_arrow_mm) - kArrowGap_mm / 2;
    }
    const double dots_begin_mm = has_ruler(sheet, other) ? free_margin_mm(sheet, other) : 0;
    // Returns true if a tick or number from `from_mm` to `to_mm` would cross the other ruler or its
    // arrow. `nearest_mm` is the minimum distance between the dots and the marks of the other ruler
    // that could be crossed.
    const auto is_crossed = [&](double from_mm, double to_mm, double nearest_mm) {
        return to_mm > crossing_mm && from_mm < dots_begin_mm - nearest_mm;
    };
    const double dots_mm =
        ((is_top ? sheet.columns : sheet.rows) - 1) * sheet.pattern.spacing_mm + 1e-6;
    const int last_mm =
        static_cast<int>((is_top ? sheet.origin_x_mm : sheet.origin_y_mm) + dots_mm);
    std::string ticks = fmt::format("{:.3f} w\n", 0.1 * kPointsPerMm);
    std::string numbers = fmt::format("BT /Label {} Tf\n", kNumber_pt);
    for (int mm = 0; mm <= last_mm; ++mm) {
        const double tick_mm = mm % 10 == 0 ? kLongTick_mm : mm % 5 == 0 ? 1.2 : 0.8;
        if (mm > 0 && !is_crossed(mm, mm, kGap_mm)) {
            ticks += at(mm, kGap_mm) + " m " + at(mm, kGap_mm + tick_mm) + " l\n";
        }
        if (mm % 10 != 0) continue;
        const std::string number = mm == 0 ? "0 mm" : fmt::format("{}", mm);
        const double length_mm = width_mm(number, kNumber_pt);
        const double from_mm = mm == 0 ? kEdge_mm : mm - length_mm / 2;
        if (is_crossed(from_mm, from_mm + length_mm, kNumberAway_mm)) continue;
        // The numbers on the left ruler read upwards, so their tops face left.
        numbers +=
            fmt::format("{} {} Tm {} Tj\n", is_top ? "1 0 0 1" : "0 1 -1 0",
                        at(is_top ? from_mm : from_mm + length_mm, kNumberAway_mm), shown(number));
    }
    return ticks + "S\n" + numbers + "ET\n";
}

/// Returns the PDF content of an arrow from the edge of the page to the position `end_mm`. The
/// arrow is parallel to x if `side` is top, and to y otherwise. `away_mm` is its position on the
/// other axis.
std::string arrow_content(const Sheet& sheet, Side side, double away_mm, double end_mm) {
    const auto at = [&](double along_mm, double aside_mm) {
        return side == Side::top ? point(sheet, along_mm, away_mm + aside_mm)
                                 : point(sheet, away_mm + aside_mm, along_mm);
    };
    const double neck_mm = end_mm - kArrowHead_mm;
    return at(kEdge_mm, 0) + " m " + at(neck_mm, 0) + " l S\n" + at(end_mm, 0) + " m " +
           at(neck_mm, 0.35 * kArrowHead_mm) + " l " + at(neck_mm, -0.35 * kArrowHead_mm) +
           " l f\n";
}

std::string label_at(const Sheet& sheet, double x_mm, double baseline_mm, const std::string& text) {
    return fmt::format("1 0 0 1 {} Tm {} Tj\n", point(sheet, x_mm, baseline_mm), shown(text));
}

/// Returns the PDF content of the x arrow and the y arrow at the corner of the page. Includes the
/// note about the corner if it fits beside the x arrow.
std::string origin_content(const Sheet& sheet) {
    const auto arrows = arrows_of(sheet);
    if (!arrows) return {};
    const double baseline_mm = arrows->y_of_x_arrow_mm + kNumberHeight_mm / 2;
    std::string texts = fmt::format("BT /Label {} Tf\n", kNumber_pt);
    texts += label_at(sheet, arrows->x_end_mm() + 0.4, baseline_mm, "x");
    texts += label_at(sheet, arrows->x_of_y_arrow_mm - 0.4,
                      arrows->y_end_mm() + 0.4 + kNumberHeight_mm, "y");
    if (has_note_at_origin(sheet)) {
        texts +=
            label_at(sheet, arrows->x_end_mm() + kNoteAway_mm, baseline_mm, corner_note(sheet));
    }
    return fmt::format("{:.3f} w\n", 0.15 * kPointsPerMm) +
           arrow_content(sheet, Side::top, arrows->y_of_x_arrow_mm, arrows->x_end_mm()) +
           arrow_content(sheet, Side::left, arrows->x_of_y_arrow_mm, arrows->y_end_mm()) + texts +
           "ET\n";
}

}  // namespace

std::string label_content(const Sheet& sheet, PageNumber page, const PrintOptions& options,
                          ScriptText& script) {
    return "q 0 0 0 1 k 0 0 0 1 K\n" + text_content(sheet, page, options, script) +
           ruler_content(sheet, Side::top) + ruler_content(sheet, Side::left) +
           origin_content(sheet) + "Q\n";
}

}  // namespace dotpose::print
