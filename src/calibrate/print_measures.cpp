#include "calibrate/print_measures.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "calibrate/print_view.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

constexpr double kInch_mm = 25.4;
/// Two dots are considered merged if the darkness halfway between them exceeds this fraction of the
/// darkness of the paler dot.
constexpr double kMergedShare = 0.6;
/// Minimum number of dots in a distortion bin. Bins with fewer dots are not reported.
constexpr int kMinBinDots = 60;
/// The darkness of solid ink is estimated as this quantile of the darkness of the dots. If the
/// expected darkness of the ink is greater than the quantile, the expected darkness is used
/// instead.
constexpr double kDarkest = 0.98;
constexpr double kSigmaPerDeviation = 1.4826;

double quantile(std::vector<double>& values, double probability) {
    if (values.empty()) return 0;
    const auto index =
        static_cast<std::size_t>(probability * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + static_cast<long>(index));
    return values[index];
}

/// Converts between px and the units of the fit, which are mm for a scan and px for a photo.
struct Units {
    Vector2d per_px = Vector2d::Ones();

    explicit Units(const std::optional<Resolution>& resolution) {
        if (!resolution) return;
        per_px = {kInch_mm / resolution->x_dpi, kInch_mm / resolution->y_dpi};
    }
    Vector2d from_px(const Vector2d& px) const { return px.cwiseProduct(per_px); }
    Vector2d to_px(const Vector2d& value) const { return value.cwiseQuotient(per_px); }
};

/// Returns the nominal position of the dot in a cell, in mm from the first cell of the region.
/// Positions relative to this cell are small numbers, which preserves precision.
Vector2d nominal_mm(const CellGrid& grid, const Field& field, const Pattern& pattern,
                    const SeenCell& cell) {
    const Vector2d origin(grid.origin.x, grid.origin.y);
    return pattern.spacing_mm * (field.code.dot_cell(cell.x, cell.y, cell.nominal) - origin);
}
Vector2d nominal_mm(const Measuring& m, const Pattern& pattern, const SeenCell& cell) {
    return nominal_mm(m.grid, m.field, pattern, cell);
}

PrintScale scale_of(const Eigen::Matrix2d& linear) {
    PrintScale scale;
    const Vector2d x = linear.col(0);
    const Vector2d y = linear.col(1);
    scale.scale_x = x.norm();
    scale.scale_y = y.norm();
    scale.rotation_rad = std::atan2(x.y(), x.x());
    scale.skew_rad = std::atan2(x.x() * y.y() - x.y() * y.x(), x.dot(y)) - std::numbers::pi / 2;
    return scale;
}

/// Map from the paper to the image, fitted to the dots of one field. Predicts the image positions
/// of these dots.
struct Fitted {
    PlaneFit fit;
    Units units;
    bool is_photo = false;  ///< true if the scale depends on the position

    double mm_per_unit(const Vector2d& place_mm) const {
        return is_photo ? 1 / fit.units_per_mm(place_mm) : 1;
    }
    double mm_per_px(const Vector2d& place_mm) const {
        return mm_per_unit(place_mm) * std::sqrt(units.per_px.x() * units.per_px.y());
    }
    /// Returns the measured minus the fitted position of a dot, in mm on the paper.
    Vector2d off_mm(const Vector2d& place_mm, const Vector2d& seen_px) const {
        return mm_per_unit(place_mm) * (units.from_px(seen_px) - fit.seen(place_mm));
    }
};

/// Returns the scatter of individual dots, computed from the differences between the offsets of
/// neighbouring dots. Distortion hardly affects these differences, because it displaces neighbours
/// almost equally.
double measure_scatter_mm(const Measuring& m, const Fitted& fitted, const Pattern& pattern) {
    std::vector<double> steps_mm;
    const auto off_mm = [&](const SeenCell& cell) {
        return fitted.off_mm(nominal_mm(m, pattern, cell), cell.centre_px());
    };
    for (int j = 0; j < m.grid.rows; ++j) {
        for (int i = 0; i + 1 < m.grid.columns; ++i) {
            const SeenCell& cell = m.grid.at(i, j);
            const SeenCell& next = m.grid.at(i + 1, j);
            if (!cell.is_right() || !next.is_right()) continue;
            const Vector2d step = off_mm(next) - off_mm(cell);
            steps_mm.push_back(std::abs(step.x()));
            steps_mm.push_back(std::abs(step.y()));
        }
    }
    return kSigmaPerDeviation * quantile(steps_mm, 0.5) / std::numbers::sqrt2;
}

void measure_distortion(const Measuring& m, const Fitted& fitted, PrintField& result) {
    std::map<std::pair<int, int>, DistortionBin> bins;
    for (int j = 0; j < m.grid.rows; ++j) {
        for (int i = 0; i < m.grid.columns; ++i) {
            const SeenCell& cell = m.grid.at(i, j);
            if (!cell.is_right()) continue;
            const Vector2d off =
                fitted.off_mm(nominal_mm(m, result.pattern, cell), cell.centre_px());
            DistortionBin& bin = bins[{j / kDistortionCells, i / kDistortionCells}];
            ++bin.dots;
            bin.u_px += double(cell.u_px);
            bin.v_px += double(cell.v_px);
            bin.du_mm += off.x();
            bin.dv_mm += off.y();
        }
    }
    for (auto& [place, bin] : bins) {
        if (bin.dots < kMinBinDots) continue;
        for (double* sum : {&bin.u_px, &bin.v_px, &bin.du_mm, &bin.dv_mm})
            *sum /= bin.dots;
        result.largest_distortion_mm =
            std::max(result.largest_distortion_mm, std::hypot(bin.du_mm, bin.dv_mm));
        result.distortion.push_back(bin);
    }
}

/// Returns true if two dots are merged, that is, if the point halfway between them is dark.
bool have_merged(const Measuring& m, const SeenCell& a, const SeenCell& b) {
    if (!a.has_dot || !b.has_dot || a.is_covered || b.is_covered) return false;
    const double paper = 0.5 * (double(a.paper) + double(b.paper));
    const double between = darkness_at(m.scan, 0.5 * (a.centre_px() + b.centre_px()), paper);
    return between > kMergedShare * double(std::min(a.peak, b.peak));
}

void count_cells(const Measuring& m, const Fitted& fitted, PrintField& result) {
    const PixelRect whole{0, 0, m.scan.width_px, m.scan.height_px};
    std::vector<bool> merged(m.grid.cells.size());
    for (int j = 0; j < m.grid.rows; ++j) {
        for (int i = 0; i < m.grid.columns; ++i) {
            const SeenCell& cell = m.grid.at(i, j);
            const Vector2d p =
                fitted.units.to_px(fitted.fit.seen(nominal_mm(m, result.pattern, cell)));
            const bool is_in_view = whole.contains(p, -result.spacing_px);
            if (!is_in_view && !cell.has_dot) continue;
            if (cell.is_covered) {
                ++result.covered;
                continue;
            }
            ++result.cells;
            if (!cell.has_dot) {
                ++result.missing;
                continue;
            }
            ++result.dots;
            result.bits_wrong += std::popcount(static_cast<unsigned>(cell.read) ^
                                               static_cast<unsigned>(cell.nominal));
            const std::size_t index = static_cast<std::size_t>(&cell - m.grid.cells.data());
            const auto compare = [&](int step_i, int step_j) {
                if (i + step_i >= m.grid.columns || j + step_j >= m.grid.rows) return;
                const SeenCell& other = m.grid.at(i + step_i, j + step_j);
                if (!have_merged(m, cell, other)) return;
                merged[index] = true;
                merged[static_cast<std::size_t>(&other - m.grid.cells.data())] = true;
            };
            compare(1, 0);
            compare(0, 1);
        }
    }
    result.merged = static_cast<int>(std::ranges::count(merged, true));
}

void measure_dots(const Measuring& m, const Fitted& fitted, PrintField& result) {
    std::vector<double> peaks;
    for (const SeenCell& cell : m.grid.cells) {
        if (cell.is_right()) peaks.push_back(double(cell.peak));
    }
    const double ink = std::max(1 - m.ink_reflectance, quantile(peaks, kDarkest));
    result.contrast = quantile(peaks, 0.5);
    result.paper_level = m.field.paper;
    std::vector<double> diameters_mm;
    for (const SeenCell& cell : m.grid.cells) {
        if (!cell.is_right()) continue;
        const double area_px2 = std::max(double(cell.mass_px2), 0.0) / ink;
        const double mm_per_px = fitted.mm_per_px(nominal_mm(m, result.pattern, cell));
        diameters_mm.push_back(mm_per_px * 2 * std::sqrt(area_px2 / std::numbers::pi));
    }
    result.dot_mm = quantile(diameters_mm, 0.5);
    for (double& diameter_mm : diameters_mm)
        diameter_mm = std::abs(diameter_mm - result.dot_mm);
    result.dot_sigma_mm = kSigmaPerDeviation * quantile(diameters_mm, 0.5);
}

/// Determines whether the measured sizes and faults of dots in a photo are reliable. In some photos
/// they are not, because noise, blur and the tone curve of the camera affect these measurements.
void judge_photo_of_dots(const Measuring& m, PrintField& result) {
    // Minimum diameter of a dot whose size can be measured. The edge of a dot has an uncertainty of
    // about one pixel.
    constexpr double kMinDot_px = 6;
    // Maximum relative scatter of the darkness of dots. With more scatter, a cell without a dot
    // cannot be distinguished from a dot with a third of the usual darkness.
    constexpr double kMaxSpread = 0.12;
    const double mm_per_px = result.pattern.spacing_mm / result.spacing_px;
    result.are_sizes_measured = result.dot_mm / mm_per_px >= kMinDot_px;
    std::vector<double> strengths;
    for (const SeenCell& cell : m.grid.cells) {
        if (cell.has_dot && !cell.is_covered) strengths.push_back(double(cell.strength));
    }
    const double middle = quantile(strengths, 0.5);
    for (double& strength : strengths)
        strength = std::abs(strength - middle);
    result.are_dots_checked = kSigmaPerDeviation * quantile(strengths, 0.5) <= kMaxSpread * middle;
}

}  // namespace

std::vector<Match> matches_of(const CellGrid& grid, const Field& field, const Pattern& pattern) {
    std::vector<Match> matches;
    for (const SeenCell& cell : grid.cells) {
        if (!cell.is_right()) continue;
        matches.push_back({nominal_mm(grid, field, pattern, cell), cell.centre_px()});
    }
    return matches;
}

bool measure_field(const Measuring& m, std::size_t min_dots, PrintField& result) {
    std::vector<Match> matches = matches_of(m.grid, m.field, result.pattern);
    if (m.grid.columns < 2 || m.grid.rows < 2 || matches.size() < min_dots) return false;
    result.origin = m.grid.origin;
    result.columns = m.grid.columns;
    result.rows = m.grid.rows;

    Fitted fitted{{}, Units(m.resolution), !m.resolution};
    for (Match& match : matches)
        match.seen = fitted.units.from_px(match.seen);
    const Vector2d middle_px(0.5 * (m.scan.width_px - 1), 0.5 * (m.scan.height_px - 1));
    fitted.fit = fit_plane(matches, m.resolution ? ViewModel::flat : ViewModel::camera, middle_px);
    const PlaneFit& fit = fitted.fit;
    const double units_per_mm = fit.units_per_mm(fit.centre_mm);
    const double px_per_unit = 1 / std::sqrt(fitted.units.per_px.prod());
    result.spacing_px = result.pattern.spacing_mm * units_per_mm * px_per_unit;
    result.residual_mm = fit.residual * fitted.mm_per_unit(fit.centre_mm);
    if (m.resolution) {
        result.scale = scale_of(fit.linear);
    } else {
        result.scale_ratio = scale_ratio_of(fit, std::max(m.scan.width_px, m.scan.height_px));
    }
    result.scatter_mm = measure_scatter_mm(m, fitted, result.pattern);
    measure_distortion(m, fitted, result);
    count_cells(m, fitted, result);
    measure_dots(m, fitted, result);
    if (!m.resolution) judge_photo_of_dots(m, result);
    return true;
}

}  // namespace dotpose::calibrate
