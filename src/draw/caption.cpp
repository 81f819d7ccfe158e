#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
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

/// A value in the caption, with its label above it.
struct Entry {
    std::string label;
    std::string value;
};

/// Estimates the width of bold text from its number of characters. Underestimates the width of text
/// with many wide letters.
double text_width(const std::string& text, double size) {
    const auto is_first_byte = [](char c) { return (c & 0xC0) != 0x80; };
    return 0.72 * size * static_cast<double>(std::ranges::count_if(text, is_first_byte));
}

/// Draws entries in columns of equal width, all in the same font size. The font size is `size`, or
/// smaller if a value would otherwise not fit in its column.
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

double sigma(const auto& covariance, std::size_t axis) {
    return std::sqrt(double{covariance[axis][axis]});
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

/// Replaces a leading hyphen with a minus sign, because the minus sign is as wide as a digit.
std::string with_minus(std::string text) {
    if (text.starts_with('-')) text.replace(0, 1, "−");
    return text;
}

/// Text of the large caption: the pose and its standard deviations.
struct Shown {
    /// Name of the coordinate frame. It is appended to the coordinate labels.
    const char* frame;
    std::string x;
    std::string y;
    double angle_rad;
    std::string sigma_x;
    std::string sigma_y;
    double sigma_rad;
};

std::string micrometres(double um) {
    return fmt::format("{:.2f} µm", um);
}

Shown in_pattern(const Fix& fix, double spacing_mm) {
    const bool has_mm = std::isfinite(spacing_mm);
    const auto place = [&](double grid) {
        return has_mm ? fmt::format("{:.3f} mm", grid * spacing_mm)
                      : fmt::format("{:.3f} spacings", grid);
    };
    const auto deviation = [&](std::size_t axis) {
        return has_mm ? micrometres(1000 * spacing_mm * sigma(fix.covariance, axis))
                      : fmt::format("{:.5f}", sigma(fix.covariance, axis));
    };
    return {"",           place(fix.x_grid()), place(fix.y_grid()),     fix.theta_rad(),
            deviation(0), deviation(1),        sigma(fix.covariance, 2)};
}

/// Returns the pose in the world, or on the sheet if the sheet has no world pose.
Shown on_sheet(const SheetPlace& place) {
    const auto shown = [](const char* frame, const char* format, double x, double y, double rad,
                          const PoseCovariance& covariance, double um) {
        return Shown{frame,
                     fmt::format(fmt::runtime(format), x),
                     fmt::format(fmt::runtime(format), y),
                     rad,
                     micrometres(um * sigma(covariance, 0)),
                     micrometres(um * sigma(covariance, 1)),
                     sigma(covariance, 2)};
    };
    if (const auto world = world_place(place)) {
        return shown(" in the world", "{:.6f} m", world->x_m, world->y_m, world->yaw_rad,
                     world->covariance, 1e6);
    }
    return shown(" on the sheet", "{:.3f} mm", place.x_mm, place.y_mm, place.theta_rad,
                 place.covariance, 1e3);
}

/// Describes the pose in each coordinate frame that the large caption does not use.
std::string other_frames(const Fix& fix, const DrawOptions& options) {
    const SheetPlace& place = *options.place;
    std::string text = "on sheet " + place.entry->name;
    if (place.entry->world) {
        text += fmt::format(": x {:.3f} mm, y {:.3f} mm, θ {:.3f}°", place.x_mm, place.y_mm,
                            degrees(place.theta_rad));
    }
    const Shown pattern = in_pattern(fix, options.spacing_mm);
    return text + fmt::format("; in the pattern: x {}, y {}, θ {:.3f}°", pattern.x, pattern.y,
                              degrees(pattern.angle_rad));
}

void draw_pose(const Fix& fix, const DrawOptions& options, double width, Svg& svg) {
    const Shown shown =
        options.place ? on_sheet(*options.place) : in_pattern(fix, options.spacing_mm);
    const auto named = [&shown](const char* coordinate) {
        return std::string(coordinate) + shown.frame;
    };
    draw_entries({{named("x"), with_minus(shown.x)},
                  {named("y"), with_minus(shown.y)},
                  {named("θ"), with_minus(fmt::format("{:.3f}°", degrees(shown.angle_rad)))}},
                 40, width / 3, kBigSize, svg);
    draw_entries({{"σ of x, y", shown.sigma_x + ", " + shown.sigma_y},
                  {"σ of θ", fmt::format("{:.4f}°", degrees(shown.sigma_rad))},
                  {"dots used, seen", fmt::format("{}, {}", fix.dots_used, fix.dots_seen)},
                  {"bit errors", fmt::format("{}", fix.bit_errors)},
                  {"probability wrong", probability(fix)},
                  {"section", fmt::format("{}, {}", fix.section.u, fix.section.v)}},
                 kSecondRow_y, width / 6, kSmallSize, svg);
    if (!options.place) return;
    const std::string others = other_frames(fix, options);
    svg.text({0, kSheetRow_y},
             std::min(kSmallSize, kSmallSize * width / text_width(others, kSmallSize)), others,
             R"(class="place" fill="#17202a")");
}

/// Breaks a string between words into lines of at most `max_bytes` bytes. A longer word is placed
/// on its own line without being split.
std::vector<std::string> wrapped(const std::string& text, std::size_t max_bytes) {
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        std::string& line = lines.back();
        if (!line.empty() && line.size() + 1 + word.size() > max_bytes) {
            lines.push_back(word);
        } else {
            line += (line.empty() ? "" : " ") + word;
        }
    }
    return lines;
}

/// Returns the message for the status of a fix, followed by the counts that explain the failure.
std::string message_of(const Fix& fix, const DeviceOptions& options) {
    std::string text = fmt::format("{}; dots seen: {}", message(fix.status), fix.dots_seen);
    if (fix.status == Status::too_few_dots) {
        text += fmt::format(", at least {} are needed", options.lattice.min_dots);
    } else if (fix.status == Status::not_certain) {
        text += fmt::format(", bits that contradict the best position: {}", fix.bit_errors);
    }
    return text;
}

void draw_failure(const Fix& fix, const std::string& reason, double width, Svg& svg) {
    constexpr double kLineHeight = 46;  // five lines fit above the legend
    svg.text({0, 70}, kBigSize, fmt::format("no fix: {}", name(fix.status)),
             R"(fill="#c0392b" font-weight="bold")");
    const auto max_bytes = static_cast<std::size_t>(width / (0.6 * kSmallSize));
    const std::vector<std::string> lines = wrapped(reason, max_bytes);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        svg.text({0, 130 + kLineHeight * static_cast<double>(i)}, kSmallSize, lines[i],
                 R"(class="reason" fill="#17202a")");
    }
}

}  // namespace

void draw_caption(const FrameView& view, const DrawOptions& draw_options, double width, Svg& svg) {
    const Fix& fix = draw_options.fix ? *draw_options.fix : view.trace().fix;
    if (fix.status == Status::ok && view.reached().pose) {
        draw_pose(fix, draw_options, width, svg);
    } else {
        const std::string& reason = draw_options.reason;
        draw_failure(fix, reason.empty() ? message_of(fix, view.trace().options) : reason, width,
                     svg);
    }
}

}  // namespace dotpose::draw
