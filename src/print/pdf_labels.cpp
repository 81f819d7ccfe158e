#include "pdf_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/core.h>
#include <qpdf/QPDFObjectHandle.hh>
#include <qpdf/QUtil.hh>

#include "geometry.hpp"
#include "pdf_dots.hpp"

namespace dotpose::print {
namespace {

constexpr double kGap_mm = 0.8;   // between ink of the pattern and any label
constexpr double kEdge_mm = 0.3;  // between a label and the edge of the page
constexpr double kText_pt = 6;
constexpr double kLine_mm = 2.5;
constexpr std::size_t kLongestName = 60;

constexpr double kNumber_pt = 4.5;
constexpr double kNumberHeight_mm = 0.718 * kNumber_pt / kPointsPerMm;  // a digit in Helvetica
constexpr double kLongTick_mm = 1.8;
constexpr double kNumberAway_mm = kGap_mm + kLongTick_mm + 0.3;
constexpr double kRulerRoom_mm = kNumberAway_mm + kNumberHeight_mm + kEdge_mm;

// Adobe font metrics of Helvetica, in thousandths of the font size, from the space to '~'.
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

/// Breaks text between words into lines no wider than `widest_mm`; a word that is wider than that
/// is cut.
std::vector<std::string> wrap(const std::string& text, double widest_mm) {
    std::vector<std::string> lines = {""};
    std::string word;
    const auto fits = [&](const std::string& line) {
        return width_mm(line, kText_pt) <= widest_mm;
    };
    const auto end_word = [&] {
        if (!lines.back().empty() && !fits(lines.back() + " " + word)) lines.emplace_back();
        if (!lines.back().empty()) lines.back() += ' ';
        for (const char c : word) {
            if (!lines.back().empty() && !fits(lines.back() + c)) lines.emplace_back();
            lines.back() += c;
        }
        word.clear();
    };
    for (const char c : text) {
        if (c == ' ') {
            end_word();
        } else {
            word += c;
        }
    }
    end_word();
    return lines;
}

std::string description(const Sheet& sheet, PageNumber page, const PrintOptions& options) {
    const Pattern& pattern = sheet.pattern;
    std::string text = options.name.substr(0, kLongestName);
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

/// Returns the PDF content of the text below the dots; the line nearest to the dots comes first.
std::string text_content(const Sheet& sheet, PageNumber page, const PrintOptions& options) {
    const double reach = reach_mm(sheet.pattern);
    const double ink_end_mm = dot_y_mm(sheet, sheet.rows - 1, 0) + reach;
    const double room_mm = sheet.height_mm - ink_end_mm - kGap_mm - kEdge_mm;
    const auto most_lines = static_cast<std::size_t>(std::max(0.0, room_mm / kLine_mm));
    const double widest_mm = (sheet.columns - 1) * sheet.pattern.spacing_mm + 2 * reach;

    const auto wrapped = [&](const std::string& utf8) {
        return wrap(QUtil::utf8_to_win_ansi(utf8), widest_mm);
    };
    std::vector<std::string> lines = wrapped(description(sheet, page, options));
    const std::vector<std::string> command = wrapped(options.command);
    // The command is left out unless all of it fits: a part of it would print another sheet.
    if (!options.command.empty() && lines.size() + command.size() <= most_lines) {
        lines.insert(lines.end(), command.begin(), command.end());
    }
    lines.resize(std::min(lines.size(), most_lines));

    std::string content = fmt::format("BT /Label {} Tf\n", kText_pt);
    double bottom_mm = sheet.height_mm - ink_end_mm - kGap_mm;
    for (const std::string& line : lines) {
        bottom_mm -= kLine_mm;
        // The baseline: a quarter of the line stays below it for g, p and commas.
        fmt::format_to(std::back_inserter(content), "1 0 0 1 {:.3f} {:.3f} Tm {} Tj\n",
                       (sheet.origin_x_mm - reach) * kPointsPerMm,
                       (bottom_mm + kLine_mm / 4) * kPointsPerMm, shown(line));
    }
    return content + "ET\n";
}

enum class Side { top, left };

/// Returns the PDF content of a ruler from the first intersection to the last, with a tick every
/// millimetre and a number every ten.
std::string ruler_content(const Sheet& sheet, Side side) {
    const double reach = reach_mm(sheet.pattern);
    const bool is_top = side == Side::top;
    const double room_mm = (is_top ? sheet.origin_y_mm : sheet.origin_x_mm) - reach;
    if (room_mm < kRulerRoom_mm) return {};
    // Converts a position along the ruler and a distance from the dots to a point of the page. The
    // ruler on the left runs downwards.
    const auto point = [&](double along_mm, double away_mm) {
        const double x_mm = sheet.origin_x_mm + (is_top ? along_mm : -reach - away_mm);
        const double y_mm = sheet.origin_y_mm + (is_top ? -reach - away_mm : along_mm);
        return fmt::format("{:.3f} {:.3f}", x_mm * kPointsPerMm,
                           (sheet.height_mm - y_mm) * kPointsPerMm);
    };
    const int count = is_top ? sheet.columns : sheet.rows;
    const int length_mm = static_cast<int>((count - 1) * sheet.pattern.spacing_mm + 1e-6);
    std::string ticks = fmt::format("{:.3f} w\n", 0.1 * kPointsPerMm);
    std::string numbers = fmt::format("BT /Label {} Tf\n", kNumber_pt);
    for (int mm = 0; mm <= length_mm; ++mm) {
        const double tick_mm = mm % 10 == 0 ? kLongTick_mm : mm % 5 == 0 ? 1.2 : 0.8;
        ticks += point(mm, kGap_mm) + " m " + point(mm, kGap_mm + tick_mm) + " l\n";
        if (mm % 10 != 0) continue;
        const std::string number = mm == 0 ? "0 mm" : fmt::format("{}", mm);
        const double half_mm = width_mm(number, kNumber_pt) / 2;
        // Beside the dots the text runs upwards, so that its top faces away from them.
        numbers +=
            fmt::format("{} {} Tm {} Tj\n", is_top ? "1 0 0 1" : "0 1 -1 0",
                        point(is_top ? mm - half_mm : mm + half_mm, kNumberAway_mm), shown(number));
    }
    return ticks + "S\n" + numbers + "ET\n";
}

}  // namespace

std::string label_content(const Sheet& sheet, PageNumber page, const PrintOptions& options) {
    return "q 0 0 0 1 k 0 0 0 1 K\n" + text_content(sheet, page, options) +
           ruler_content(sheet, Side::top) + ruler_content(sheet, Side::left) + "Q\n";
}

}  // namespace dotpose::print
