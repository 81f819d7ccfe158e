// Draws the results of a drive: the path on the page, a scatter plot of the position errors, and a
// plot of the errors over time.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

constexpr double kPathMargin = 40;
constexpr double kPathHead = 70;
constexpr double kPageHeight = 1000;
constexpr double kPlotWidth = 760;
constexpr double kScatterSide = 500;

struct Error_um {
    std::size_t frame = 0;
    Point offset;  ///< measured minus true position
};

std::vector<Error_um> errors_of(std::span<const PathPoint> path) {
    std::vector<Error_um> errors;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const PathPoint& p = path[i];
        if (!p.is_fix) continue;
        errors.push_back(
            {i, {1000 * (p.measured_x_mm - p.true_x_mm), 1000 * (p.measured_y_mm - p.true_y_mm)}});
    }
    return errors;
}

/// Rounds up to 1, 2 or 5 times a power of ten. Returns 1 if `value` is not positive.
double round_up(double value) {
    if (!(value > 0)) return 1;
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= value) return factor * power;
    }
    return 10 * power;
}

class PathSketch {
  public:
    PathSketch(const Sheet& sheet, std::span<const PathPoint> path, const std::string& title)
        : sheet_(sheet),
          path_(path),
          errors_(errors_of(path)),
          scale_(std::min(kPageHeight / sheet.height_mm, 1400 / sheet.width_mm)),
          svg_(width(), height(), title) {
        for (const Error_um& error : errors_) {
            worst_um_ = std::max(worst_um_, length(error.offset));
        }
        svg_.text({kPathMargin, kPathMargin + 36}, 38, title,
                  R"(font-weight="bold" fill="#17202a")");
    }

    std::string draw() && {
        draw_page();
        const double x = 2.5 * kPathMargin + sheet_.width_mm * scale_;
        const double y = kPathMargin + kPathHead;
        draw_scatter(x, y);
        draw_errors(x, y + kScatterSide + 2.4 * kPathMargin, plot_height());
        return std::move(svg_).finish();
    }

  private:
    double page_height() const { return std::max(sheet_.height_mm * scale_, 860.0); }
    double plot_height() const { return page_height() - kScatterSide - 3.6 * kPathMargin; }
    double width() const { return sheet_.width_mm * scale_ + kPlotWidth + 3.5 * kPathMargin; }
    double height() const { return page_height() + kPathHead + 2 * kPathMargin; }

    void draw_page();
    void draw_scatter(double x, double y);
    void draw_errors(double x, double y, double height);
    std::string path_data() const;

    const Sheet& sheet_;
    std::span<const PathPoint> path_;
    std::vector<Error_um> errors_;
    double scale_;  ///< drawing units per mm of the page
    double worst_um_ = 0;
    Svg svg_;
};

std::string PathSketch::path_data() const {
    std::string data;
    for (const PathPoint& p : path_) {
        data += fmt::format("{}{:.2f} {:.2f}", data.empty() ? 'M' : 'L', p.true_x_mm * scale_,
                            p.true_y_mm * scale_);
    }
    return data;
}

void PathSketch::draw_page() {
    const double page_width = sheet_.width_mm * scale_;
    const double page_height = sheet_.height_mm * scale_;
    svg_.add(R"svg(<g transform="translate({:.2f} {:.2f})">)svg", kPathMargin,
             kPathMargin + kPathHead);
    svg_.add(R"(<rect width="{:.2f}" height="{:.2f}" fill="#fdfcf7" stroke="#b8c0c8" )"
             R"(stroke-width="2"/>)",
             page_width, page_height);
    const double spacing_mm = sheet_.pattern.spacing_mm;
    svg_.add(R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="#eef1f4"/>)",
             (sheet_.origin_x_mm - spacing_mm / 2) * scale_,
             (sheet_.origin_y_mm - spacing_mm / 2) * scale_, sheet_.columns * spacing_mm * scale_,
             sheet_.rows * spacing_mm * scale_);
    svg_.add(R"(<path class="truth" d="{}" fill="none" stroke="{}" stroke-width="9" )"
             R"(stroke-opacity="0.28" stroke-linejoin="round" stroke-linecap="round"/>)",
             path_data(), colour::kInk);
    svg_.add(R"(<g class="measured" fill="{}">)", colour::kGood);
    for (const PathPoint& p : path_) {
        if (p.is_fix) {
            svg_.circle({p.measured_x_mm * scale_, p.measured_y_mm * scale_}, 2.6, {});
        }
    }
    svg_.add("</g>");
    svg_.add(R"(<g class="lost" fill="none" stroke="{}" stroke-width="3">)", colour::kBad);
    for (const PathPoint& p : path_) {
        if (!p.is_fix) svg_.circle({p.true_x_mm * scale_, p.true_y_mm * scale_}, 7, {});
    }
    svg_.add("</g>");
    const double ruler_mm = round_up(sheet_.width_mm / 11);
    const Point left{(sheet_.width_mm - ruler_mm) * scale_ - 24, page_height - 28};
    svg_.line(left, left + Point{ruler_mm * scale_, 0},
              fmt::format(R"(stroke="{}" stroke-width="4")", colour::kInk));
    svg_.text(left + Point{ruler_mm * scale_ / 2, -12}, 24, fmt::format("{:g} mm", ruler_mm),
              R"(text-anchor="middle" fill="#17202a")");
    svg_.add("</g>");
}

void PathSketch::draw_scatter(double x, double y) {
    const Point middle{kScatterSide / 2, kScatterSide / 2};
    const double reach_um = round_up(worst_um_);
    const double scale = 0.94 * kScatterSide / 2 / reach_um;
    svg_.add(R"svg(<g transform="translate({:.2f} {:.2f})">)svg", x, y);
    svg_.add(R"(<rect width="{0:.0f}" height="{0:.0f}" fill="#f7f9fb" stroke="{1}"/>)",
             kScatterSide, colour::kFrame);
    const std::string ring = fmt::format(R"(fill="none" stroke="{}" stroke-width="2")", "#b8c0c8");
    svg_.circle(middle, reach_um * scale, ring);
    svg_.circle(middle, reach_um * scale / 2, ring);
    svg_.add(R"(<g stroke="#b8c0c8" stroke-width="1.5">)");
    svg_.line({0, middle.y}, {kScatterSide, middle.y}, {});
    svg_.line({middle.x, 0}, {middle.x, kScatterSide}, {});
    svg_.add("</g>");
    svg_.add(R"(<g class="errors" fill="{}" fill-opacity="0.55">)", colour::kGood);
    for (const Error_um& error : errors_) {
        svg_.circle(middle + scale * error.offset, 4, {});
    }
    svg_.add("</g>");
    svg_.text({middle.x + 8, middle.y - reach_um * scale + 26}, 22,
              fmt::format("{:g} µm", reach_um), R"(fill="#6b7885")");
    svg_.text({middle.x + 8, middle.y - reach_um * scale / 2 + 26}, 22,
              fmt::format("{:g} µm", reach_um / 2), R"(fill="#6b7885")");
    svg_.text({kScatterSide - 10, middle.y - 8}, 22, "x", R"(text-anchor="end" fill="#6b7885")");
    svg_.text({middle.x - 10, kScatterSide - 10}, 22, "y", R"(text-anchor="end" fill="#6b7885")");

    std::vector<double> distances_um;
    for (const Error_um& error : errors_)
        distances_um.push_back(length(error.offset));
    std::ranges::sort(distances_um);
    const double text_x = kScatterSide + 30;
    const auto entry = [&](double row, const char* label, const std::string& value) {
        svg_.text({text_x, 24 + row}, 24, label, R"(fill="#6b7885")");
        svg_.text({text_x, 66 + row}, 38, value, R"(fill="#17202a" font-weight="bold")");
    };
    entry(0, "frames", fmt::format("{}", path_.size()));
    entry(110, "fixes", fmt::format("{}", errors_.size()));
    if (!errors_.empty()) {
        entry(220, "median error", fmt::format("{:.1f} µm", distances_um[errors_.size() / 2]));
        entry(330, "largest error", fmt::format("{:.1f} µm", distances_um.back()));
    }
    svg_.add("</g>");
}

void PathSketch::draw_errors(double x, double y, double height) {
    const double reach_um = round_up(worst_um_);
    const double left = 90;
    const double width = kPlotWidth - left;
    const auto last = static_cast<double>(std::max<std::size_t>(path_.size(), 2) - 1);
    svg_.add(R"svg(<g transform="translate({:.2f} {:.2f})">)svg", x, y);
    svg_.text({0, -16}, 24, "error of each frame", R"(fill="#6b7885")");
    // The number of divisions is 4 or 5, whichever makes the steps 1, 2 or 5 times a power of ten.
    const int steps = std::fmod(std::round(std::log10(reach_um / 2) * 1e6), 1e6) == 0 ? 4 : 5;
    for (int step = 0; step <= steps; ++step) {
        const double line_y = height * (1 - static_cast<double>(step) / steps);
        svg_.line({left, line_y}, {kPlotWidth, line_y},
                  fmt::format(R"(stroke="{}" stroke-width="1.5")", colour::kFrame));
        svg_.text({left - 12, line_y + 8}, 22, fmt::format("{:g}", reach_um * step / steps),
                  R"(text-anchor="end" fill="#6b7885")");
    }
    svg_.text({0, 8}, 22, "µm", R"(fill="#6b7885")");
    svg_.add(R"(<g class="error-bars" stroke="{}" stroke-width="1.4">)", colour::kGood);
    for (const Error_um& error : errors_) {
        const double at = left + width * static_cast<double>(error.frame) / last;
        svg_.line({at, height}, {at, height * (1 - length(error.offset) / reach_um)}, {});
    }
    svg_.add("</g>");
    svg_.text({left, height + 32}, 22, "0", R"(text-anchor="middle" fill="#6b7885")");
    svg_.text({kPlotWidth, height + 32}, 22, fmt::format("{:g}", last),
              R"(text-anchor="end" fill="#6b7885")");
    svg_.text({left + width / 2, height + 32}, 22, "frame",
              R"(text-anchor="middle" fill="#6b7885")");
    svg_.add("</g>");
}

}  // namespace

void draw_path(std::ostream& out, const Sheet& sheet, std::span<const PathPoint> path,
               const std::string& title) {
    out << PathSketch(sheet, path, title).draw();
}

void draw_path(const std::filesystem::path& file, const Sheet& sheet,
               std::span<const PathPoint> path, const std::string& title) {
    draw::write_file(file, [&](std::ostream& out) { draw_path(out, sheet, path, title); });
}

}  // namespace dotpose
