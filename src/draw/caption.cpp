#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "draw/frame_panels.hpp"

namespace dotpose::draw {
namespace {

constexpr double kLabelSize = 27;
constexpr double kBigSize = 60;
constexpr double kSmallSize = 36;
constexpr double kSecondRow_y = 190;
constexpr double kSheetRow_y = 292;

/// A value of the caption; its name is drawn above it.
struct Entry {
    const char* label;
    std::string value;
};

/// Estimates the width of bold text without wide letters.
double text_width(const std::string& text, double size) {
    const auto is_first_byte = [](char c) { return (c & 0xC0) != 0x80; };
    return 0.72 * size * static_cast<double>(std::ranges::count_if(text, is_first_byte));
}

/// Draws entries in columns of equal width; an entry that is wider gets a smaller font.
void draw_entries(const std::vector<Entry>& entries, double y, double column, double size,
                  Svg& svg) {
    double font = size;
    for (const Entry& entry : entries) {
        font = std::min(font, size * (column - 20) / text_width(entry.value, size));
    }
    double x = 0;
    for (const Entry& entry : entries) {
        svg.text({x, y}, kLabelSize, entry.label, R"(fill="#6b7885")");
        svg.text({x, y + 0.45 * kLabelSize + size}, font, entry.value,
                 R"(fill="#17202a" font-weight="bold")");
        x += column;
    }
}

double sigma(const Fix& fix, std::size_t axis) {
    return std::sqrt(static_cast<double>(fix.covariance[axis][axis]));
}

constexpr double degrees(double angle_rad) {
    return angle_rad * 180 / std::numbers::pi;
}

std::string probability(const Fix& fix) {
    const int digits = static_cast<int>(std::ceil(fix.p_wrong_log2 * std::log10(2.0)));
    std::string exponent;
    for (const char c : std::to_string(std::max(digits, -30))) {
        constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
        exponent += c == '-' ? "⁻" : kRaised[c - '0'];
    }
    return "≤ 10" + exponent;
}

/// Replaces a leading hyphen by a minus sign, which is as wide as a digit.
std::string with_minus(std::string text) {
    if (text.starts_with('-')) text.replace(0, 1, "−");
    return text;
}

void draw_pose(const Fix& fix, const DrawOptions& draw_options, double width, Svg& svg) {
    const double spacing_mm = draw_options.spacing_mm;
    const bool has_mm = std::isfinite(spacing_mm);
    const auto place = [&](double grid) {
        return has_mm ? fmt::format("{:.3f} mm", grid * spacing_mm)
                      : fmt::format("{:.3f} spacings", grid);
    };
    draw_entries({{"x", place(fix.x_grid())},
                  {"y", place(fix.y_grid())},
                  {"θ", with_minus(fmt::format("{:.3f}°", degrees(fix.theta_rad())))}},
                 40, width / 3, kBigSize, svg);
    const auto sigma_text = [&](std::size_t axis) {
        return has_mm ? fmt::format("{:.2f} µm", 1000 * spacing_mm * sigma(fix, axis))
                      : fmt::format("{:.5f}", sigma(fix, axis));
    };
    draw_entries({{"σ of x, y", sigma_text(0) + ", " + sigma_text(1)},
                  {"σ of θ", fmt::format("{:.4f}°", degrees(sigma(fix, 2)))},
                  {"dots used, seen", fmt::format("{}, {}", fix.dots_used, fix.dots_seen)},
                  {"bit errors", fmt::format("{}", fix.bit_errors)},
                  {"probability wrong", probability(fix)},
                  {"section", fmt::format("{}, {}", fix.section.u, fix.section.v)}},
                 kSecondRow_y, width / 6, kSmallSize, svg);
    if (draw_options.sheet.empty()) return;
    const std::string sheet = "on sheet " + draw_options.sheet;
    svg.text({0, kSheetRow_y},
             std::min(kSmallSize, kSmallSize * width / text_width(sheet, kSmallSize)), sheet,
             R"(class="place" fill="#17202a")");
}

void draw_failure(const Fix& fix, const Options& options, Svg& svg) {
    svg.text({0, 88}, kBigSize, fmt::format("no fix: {}", name(fix.status)),
             R"(fill="#c0392b" font-weight="bold")");
    svg.text({0, 150}, kSmallSize, message(fix.status), R"(fill="#17202a")");
    std::string counts = fmt::format("dots seen: {}", fix.dots_seen);
    if (fix.status == Status::too_few_dots) {
        counts += fmt::format(", at least {} are needed", options.lattice.min_dots);
    } else if (fix.status == Status::not_certain) {
        counts += fmt::format(", bits that contradict the best position: {}", fix.bit_errors);
    }
    svg.text({0, 205}, kSmallSize, counts, R"(fill="#6b7885")");
}

}  // namespace

void draw_caption(const FrameView& view, const DrawOptions& draw_options, double width, Svg& svg) {
    const Fix& fix = view.trace().fix;
    if (view.reached().pose) {
        draw_pose(fix, draw_options, width, svg);
    } else {
        draw_failure(fix, view.trace().options, svg);
    }
}

}  // namespace dotpose::draw
