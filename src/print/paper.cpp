#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>

#include <fmt/core.h>

#include "dotpose/tools/print.hpp"
#include "lower_case.hpp"

namespace dotpose {
namespace {

struct NamedPaper {
    std::string_view name;
    Paper paper;
};

// Sizes in portrait orientation, according to ISO 216 and ANSI/ASME Y14.1.
constexpr std::array<NamedPaper, 10> kPapers = {{
    {"a0", {841, 1189}},
    {"a1", {594, 841}},
    {"a2", {420, 594}},
    {"a3", {297, 420}},
    {"a4", {210, 297}},
    {"a5", {148, 210}},
    {"a6", {105, 148}},
    {"letter", {215.9, 279.4}},
    {"legal", {215.9, 355.6}},
    {"tabloid", {279.4, 431.8}},
}};

std::optional<double> parse_length_mm(std::string_view text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end) return std::nullopt;
    return value;
}

}  // namespace

Paper paper_by_name(std::string_view name) {
    const std::string lower = print::lower_case(name);
    for (const NamedPaper& known : kPapers) {
        if (known.name == lower) return known.paper;
    }
    const std::size_t cross = lower.find('x');
    if (cross != std::string::npos) {
        const auto width_mm = parse_length_mm(std::string_view(lower).substr(0, cross));
        const auto height_mm = parse_length_mm(std::string_view(lower).substr(cross + 1));
        if (width_mm && height_mm) {
            const auto in_range = [](double mm) { return mm > 0 && mm <= kMaxPage_mm; };
            if (in_range(*width_mm) && in_range(*height_mm)) return {*width_mm, *height_mm};
            throw BadArgument(
                fmt::format("paper size '{}': each side must be over 0 and at most "
                            "{:.0f} mm",
                            name, kMaxPage_mm));
        }
    }
    throw BadArgument(
        fmt::format("unknown paper size '{}'; known are A0 to A6, Letter, Legal, "
                    "Tabloid and WIDTHxHEIGHT in mm, for example 100x62.5",
                    name));
}

Paper landscape(Paper paper) {
    return {std::max(paper.width_mm, paper.height_mm), std::min(paper.width_mm, paper.height_mm)};
}

}  // namespace dotpose
