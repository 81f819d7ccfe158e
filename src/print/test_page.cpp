#include "dotpose/tools/test_page.hpp"

#include <cmath>

#include <fmt/core.h>

#include "geometry.hpp"

namespace dotpose {
namespace {

constexpr int kMaxSetting = 80;
constexpr double kLabelHeight_mm = 2.5;
/// Width of the blank space around a label and between patches.
constexpr double kGap_mm = 2;
void validate(const std::vector<int>& settings) {
    if (settings.empty()) throw BadArgument("a test page needs spacings and dot sizes");
    for (const int setting : settings) {
        if (setting >= 1 && setting <= kMaxSetting) continue;
        throw BadArgument(
            fmt::format("a setting of {}/1200 inch: it must be 1 to {}", setting, kMaxSetting));
    }
}

Pattern pattern_of(CodeVariant code, int spacing, int dot) {
    Pattern pattern;
    pattern.code = code;
    pattern.spacing_mm = spacing * kTestUnit_mm;
    pattern.displacement_mm = pattern.spacing_mm / 6;
    pattern.dot_mm = dot * kTestUnit_mm;
    return pattern;
}

bool would_touch(const Pattern& pattern) {
    return pattern.dot_mm >= pattern.spacing_mm - 2 * pattern.displacement_mm;
}

Cell first_cell(int spacing, int dot) {
    const auto at = [](int setting) {
        return kTestPageCell + kTestPatchCells * static_cast<std::uint32_t>(setting);
    };
    return {at(spacing), at(dot)};
}

/// Returns the setting of the patch whose first cell is nearest to a coordinate, or 0 if no patch
/// is near. The coordinate may be slightly outside the patch, because the maps that `check_print`
/// fits extend beyond the patch.
int setting_at(std::uint32_t coordinate) {
    constexpr std::uint32_t kHalf = kTestPatchCells / 2;
    if (coordinate < kTestPageCell + kHalf) return 0;
    const auto setting = static_cast<int>((coordinate - kTestPageCell + kHalf) / kTestPatchCells);
    return setting <= kMaxSetting ? setting : 0;
}

/// Rounds a length to whole printer pixels at 300 dpi. With rounded lengths, the dots of all
/// patches have the same position relative to the printer's pixels.
double snapped_mm(double mm) {
    return std::round(mm / print::kPixelAt300Dpi_mm) * print::kPixelAt300Dpi_mm;
}

}  // namespace

PrintPage make_test_page(const TestPageOptions& options) {
    validate(options.spacings);
    validate(options.dots);
    PrintPage page;
    page.width_mm = options.paper.width_mm;
    page.height_mm = options.paper.height_mm;
    const double width_mm =
        (page.width_mm - 2 * options.margin_mm) / static_cast<double>(options.spacings.size());
    const double height_mm =
        (page.height_mm - 2 * options.margin_mm) / static_cast<double>(options.dots.size());
    const double label_mm = kLabelHeight_mm + 2 * kGap_mm;
    for (std::size_t column = 0; column < options.spacings.size(); ++column) {
        for (std::size_t row = 0; row < options.dots.size(); ++row) {
            SheetOptions patch;
            patch.pattern = pattern_of(options.code, options.spacings[column], options.dots[row]);
            if (would_touch(patch.pattern)) continue;
            patch.origin = first_cell(options.spacings[column], options.dots[row]);
            patch.paper = {width_mm - kGap_mm, height_mm - label_mm};
            patch.margin_mm = 0;
            Sheet sheet = make_sheet(patch);
            const double left_mm =
                snapped_mm(options.margin_mm + static_cast<double>(column) * width_mm);
            const double top_mm =
                snapped_mm(options.margin_mm + static_cast<double>(row) * height_mm);
            sheet.width_mm = page.width_mm;
            sheet.height_mm = page.height_mm;
            sheet.origin_x_mm += left_mm;
            sheet.origin_y_mm += top_mm + snapped_mm(label_mm);
            page.sheets.push_back(sheet);
            const auto label = ink_text(
                fmt::format("{:.3f}/{:.3f}", patch.pattern.spacing_mm, patch.pattern.dot_mm),
                left_mm, top_mm + kGap_mm, kLabelHeight_mm);
            page.marks.insert(page.marks.end(), label.begin(), label.end());
        }
    }
    return page;
}

std::optional<Pattern> test_patch_at(CodeVariant code, Cell cell) {
    const int spacing = setting_at(cell.x);
    const int dot = setting_at(cell.y);
    if (spacing == 0 || dot == 0) return std::nullopt;
    const Pattern pattern = pattern_of(code, spacing, dot);
    return would_touch(pattern) ? std::nullopt : std::optional(pattern);
}

}  // namespace dotpose
