#include "calibrate/print_dots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

constexpr std::array kSymbols = {Symbol::up, Symbol::left, Symbol::right, Symbol::down};
/// Maximum distance of a dot from its intersection along x and y, in spacings. Ink at a larger
/// distance belongs to a different dot.
constexpr double kMaxOffset = 0.42;
/// Minimum darkness of a dot, relative to that of a typical dot.
constexpr double kMinShare = 0.35;
/// Level, relative to the darkness of a dot, that is subtracted before the centroid is computed.
/// The subtraction suppresses noise and JPEG ringing.
constexpr double kFloorShare = 0.15;
/// Radius, in spacings, within which the pixels of a dot are summed. It is half the minimum
/// distance between two dots.
constexpr double kReach = 1.0 / 3;
/// The border of a cell is considered covered by other print, such as text or pictures, if its
/// darkness exceeds both of these limits. The first limit is relative to the darkness of a dot. The
/// second limit is in standard deviations of the darkness of blank paper, and is capped at the
/// darkness of a dot.
constexpr double kOtherPrintShare = 0.35;
constexpr double kOtherPrint_sigmas = 6;
/// Displacement, in spacings, assumed for the measurement of the grey levels. An approximate value
/// is sufficient.
constexpr double kUsualDisplacement = 1.0 / 6;
constexpr int kCentrings = 4;
constexpr double kCentred_px = 0.01;

/// Returns the median. Reorders the values.
double median(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Removes the levels of grey areas beside the paper. `levels` contains the levels at the corners
/// of cells, in ascending order. At least a quarter of these levels are assumed to be paper.
/// Estimates the standard deviation of the paper levels from the 75 % and 95 % quantiles, and
/// removes levels more than kSigmas standard deviations below the 75 % quantile.
void keep_paper(std::vector<double>& levels) {
    constexpr double kSigmas = 3.6;
    constexpr double kSigmasPerRange = 1.6449 - 0.6745;
    const auto quantile = [&](double fraction) {
        return levels[static_cast<std::size_t>(fraction * static_cast<double>(levels.size() - 1))];
    };
    const double low =
        quantile(0.75) - kSigmas / kSigmasPerRange * (quantile(0.95) - quantile(0.75));
    levels.erase(levels.begin(), std::ranges::lower_bound(levels, low));
}

/// Returns the mean of the middle half of sorted values.
double middle_mean(const std::vector<double>& values) {
    const std::size_t quarter = values.size() / 4;
    double sum = 0;
    for (std::size_t i = quarter; i < values.size() - quarter; ++i)
        sum += values[i];
    return sum / static_cast<double>(values.size() - 2 * quarter);
}

/// Returns the grey level at a point, interpolated linearly.
double level_at(const ImageView& scan, const Vector2d& pixel) {
    const double u = std::clamp(pixel.x(), 0.0, scan.width_px - 1.001);
    const double v = std::clamp(pixel.y(), 0.0, scan.height_px - 1.001);
    const auto first_u = static_cast<int>(u);
    const auto first_v = static_cast<int>(v);
    const std::uint8_t* upper = scan.row(first_v) + first_u;
    const std::uint8_t* lower = upper + scan.stride_bytes;
    const double du = u - first_u;
    const double top = upper[0] + du * (upper[1] - upper[0]);
    const double bottom = lower[0] + du * (lower[1] - lower[0]);
    return top + (v - first_v) * (bottom - top);
}

struct CellRange {
    std::int64_t x_begin = 0;
    std::int64_t x_end = 0;
    std::int64_t y_begin = 0;
    std::int64_t y_end = 0;
};

/// Returns the range of cells that may be inside a rectangle.
CellRange cells_in(const PixelRect& rect, const TileMap& map) {
    Vector2d low = Vector2d::Constant(1e18);
    Vector2d high = -low;
    for (const int u : {rect.u_begin, rect.u_end}) {
        for (const int v : {rect.v_begin, rect.v_end}) {
            const Vector2d cell = map.cell(Vector2d(u, v));
            low = low.cwiseMin(cell);
            high = high.cwiseMax(cell);
        }
    }
    const auto first = [](double cell) {
        return std::max<std::int64_t>(std::llround(std::floor(cell - 0.5)), 0);
    };
    const auto end = [](double cell) {
        return std::min<std::int64_t>(std::llround(std::ceil(cell + 1.5)), kPositionsPerAxis);
    };
    return {first(low.x()), end(high.x()), first(low.y()), end(high.y())};
}

/// Measures the dots in one tile. Darkness is relative to the paper in the tile.
class Meter {
  public:
    Meter(const ImageView& scan, const TileMap& map, double displacement, double paper)
        : scan_(scan),
          map_(map),
          displacement_(displacement),
          reach_px_(kReach * map.spacing_px()),
          inner_px2_(std::pow(std::max(reach_px_ - 0.5, 0.0), 2)),
          outer_px2_(std::pow(reach_px_ + 0.5, 2)),
          sample_px_(0.5 * displacement * map.spacing_px()),
          paper_(paper),
          per_paper_(1 / paper) {}

    /// Returns the darkest of the four possible positions of a dot.
    Vector2d darkest_place(const Vector2d& intersection_px) const {
        Vector2d darkest_px = intersection_px;
        double best = -1e9;
        for (const Symbol symbol : kSymbols) {
            const Vector2d offset(dx(symbol), dy(symbol));
            const Vector2d place = intersection_px + map_.px_per_cell * (displacement_ * offset);
            const double strength = strength_at(place);
            if (strength <= best) continue;
            best = strength;
            darkest_px = place;
        }
        return darkest_px;
    }

    /// Starts at the darkest of the four possible positions of a dot, moves iteratively to the
    /// centroid of the dot, and measures the dot there. Sets the measured members of `cell`, except
    /// `is_covered` and `read`. `strength` is the expected darkness of a dot. Returns the offset of
    /// the dot from its intersection, in spacings.
    Vector2d measure(const Vector2d& intersection_px, double strength, SeenCell& cell) const {
        Vector2d place_px = darkest_place(intersection_px);
        double moved_px = 1;
        for (int i = 0; i < kCentrings && moved_px > kCentred_px; ++i) {
            const Vector2d before = place_px;
            place_px = centroid(place_px, kFloorShare * strength);
            moved_px = (place_px - before).norm();
        }
        const Vector2d offset = map_.cells_per_px * (place_px - intersection_px);
        cell.strength = static_cast<float>(strength_at(place_px) / strength);
        cell.has_dot =
            double(cell.strength) >= kMinShare && offset.cwiseAbs().maxCoeff() <= kMaxOffset;
        if (!cell.has_dot) return offset;
        cell.u_px = static_cast<float>(place_px.x());
        cell.v_px = static_cast<float>(place_px.y());
        cell.paper = static_cast<float>(paper_);
        cell.peak = static_cast<float>(darkness_at(scan_, place_px, paper_));
        cell.mass_px2 = static_cast<float>(mass(place_px));
        return offset;
    }

    /// Returns true if the border of a cell differs from `paper_` by more than `min_darkness`, in
    /// either direction. The border may be lighter than `paper_`, because `paper_` is too dark if
    /// grey print fills most of the tile. The middles of the four sides are not checked, because
    /// swollen dots may merge there.
    bool is_covered(const Vector2d& intersection_px, double min_darkness) const {
        const Vector2d x = map_.px_per_cell.col(0);
        const Vector2d y = map_.px_per_cell.col(1);
        for (const double along : {-0.5, -0.25, 0.25}) {
            for (const Vector2d& step :
                 {Vector2d(along * x - 0.5 * y), Vector2d(0.5 * x + along * y),
                  Vector2d(0.5 * y - along * x), Vector2d(-0.5 * x - along * y)}) {
                const double darkness = darkness_at(scan_, intersection_px + step, paper_);
                if (std::abs(darkness) > min_darkness) return true;
            }
        }
        return false;
    }

    /// Returns the mean darkness of five points at and around `p`.
    double strength_at(const Vector2d& p) const {
        double sum = darkness_at(scan_, p, paper_);
        for (const double step : {-sample_px_, sample_px_}) {
            sum += darkness_at(scan_, p + Vector2d(step, 0), paper_);
            sum += darkness_at(scan_, p + Vector2d(0, step), paper_);
        }
        return sum / 5;
    }

  private:
    /// Calls visit(u, v, darkness, weight) for each pixel near `p`. At the edge of the
    /// neighbourhood, the weight decreases to 0 over a distance of one pixel, so that sums are
    /// continuous functions of `p`.
    template <typename Visit>
    void visit_around(const Vector2d& p, Visit visit) const {
        const auto first = [&](double centre) {
            return std::max(static_cast<int>(std::ceil(centre - reach_px_ - 0.5)), 0);
        };
        const auto last = [&](double centre, int count) {
            return std::min(static_cast<int>(std::floor(centre + reach_px_ + 0.5)), count - 1);
        };
        for (int v = first(p.y()); v <= last(p.y(), scan_.height_px); ++v) {
            const std::uint8_t* row = scan_.row(v);
            for (int u = first(p.x()); u <= last(p.x(), scan_.width_px); ++u) {
                const double squared = (Vector2d(u, v) - p).squaredNorm();
                if (squared >= outer_px2_) continue;
                const double weight =
                    squared <= inner_px2_ ? 1 : reach_px_ + 0.5 - std::sqrt(squared);
                visit(u, v, 1 - row[u] * per_paper_, weight);
            }
        }
    }

    Vector2d centroid(const Vector2d& p, double floor) const {
        double sum = 0;
        Vector2d moment = Vector2d::Zero();
        visit_around(p, [&](int u, int v, double darkness, double weight) {
            const double fraction = weight * std::max(darkness - floor, 0.0);
            sum += fraction;
            moment += fraction * Vector2d(u, v);
        });
        return sum > 0 ? Vector2d(moment / sum) : p;
    }

    double mass(const Vector2d& p) const {
        double sum = 0;
        visit_around(p,
                     [&](int, int, double darkness, double weight) { sum += weight * darkness; });
        return sum;
    }

    const ImageView& scan_;
    const TileMap& map_;
    double displacement_;
    double reach_px_;
    /// Pixels have partial weight if their squared distances from the point are between these
    /// limits.
    double inner_px2_;
    double outer_px2_;
    double sample_px_;
    double paper_;
    double per_paper_;
};

Symbol nearest_symbol(const Vector2d& offset) {
    if (std::abs(offset.x()) > std::abs(offset.y()))
        return offset.x() > 0 ? Symbol::right : Symbol::left;
    return offset.y() > 0 ? Symbol::down : Symbol::up;
}

/// Reads the symbols of the dots from their offsets in spacings. First subtracts the mean error of
/// the offsets, ignoring large errors. This correction is necessary because a renderer or scanner
/// that rounds dots to whole pixels displaces all dots equally, and the map of a fix does not
/// include this displacement.
void read_symbols(const std::vector<Vector2d>& offsets, double displacement,
                  std::vector<SeenCell>& cells) {
    constexpr double kMaxError = 0.25;
    Vector2d error_sum = Vector2d::Zero();
    double count = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!cells[i].has_dot) continue;
        const Symbol nominal = cells[i].nominal;
        const Vector2d error = offsets[i] - displacement * Vector2d(dx(nominal), dy(nominal));
        if (error.norm() > kMaxError) continue;
        error_sum += error;
        ++count;
    }
    const Vector2d mean_error = error_sum / std::max(count, 1.0);
    for (std::size_t i = 0; i < cells.size(); ++i)
        cells[i].read = nearest_symbol(offsets[i] - mean_error);
}

}  // namespace

Symbol Code::symbol(std::int64_t x, std::int64_t y) const {
    return symbol_at(code, {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)}, section);
}

Vector2d Code::dot_cell(std::int64_t x, std::int64_t y, Symbol symbol) const {
    return {static_cast<double>(x) + displacement * dx(symbol),
            static_cast<double>(y) + displacement * dy(symbol)};
}

double darkness_at(const ImageView& scan, const Vector2d& pixel, double paper) {
    return 1 - level_at(scan, pixel) / paper;
}

PrintLevels measure_levels(const ImageView& scan, const TileMap& map,
                           const std::vector<Vector2d>& dots_px) {
    if (dots_px.empty()) return {};
    std::vector<double> levels;
    std::vector<double> strengths;
    for (const Vector2d& dot_px : dots_px) {
        // Measures the level of the paper at a corner of the cell. Dots do not extend to the
        // corners.
        const Vector2d cell = map.cell(dot_px);
        const double level =
            level_at(scan, map.pixel({std::round(cell.x()) + 0.5, std::round(cell.y()) + 0.5}));
        levels.push_back(level);
        const Meter meter(scan, map, kUsualDisplacement, level);
        if (level > 0) strengths.push_back(meter.strength_at(dot_px));
    }
    std::ranges::sort(levels);
    keep_paper(levels);
    PrintLevels result;
    result.dot = median(strengths);
    result.paper = middle_mean(levels);
    if (result.paper <= 0) return result;
    // Standard deviation of a normal distribution, divided by its interquartile range.
    constexpr double kSigmaPerQuartiles = 1 / (2 * 0.6745);
    const std::size_t quarter = levels.size() / 4;
    result.noise =
        kSigmaPerQuartiles * (levels[levels.size() - 1 - quarter] - levels[quarter]) / result.paper;
    return result;
}

std::vector<SeenCell> measure_cells(const ImageView& scan, const PixelRect& rect,
                                    const TileMap& map, const PrintLevels& levels,
                                    const Code& code) {
    std::vector<SeenCell> cells;
    std::vector<Vector2d> offsets;
    if (levels.paper <= 0) return cells;
    // Ink that is as dark as a dot is considered other print, regardless of the noise.
    const double other_print = std::max(kOtherPrintShare * levels.dot,
                                        std::min(kOtherPrint_sigmas * levels.noise, levels.dot));
    const Meter meter(scan, map, code.displacement, levels.paper);
    const CellRange range = cells_in(rect, map);
    const PixelRect whole{0, 0, scan.width_px, scan.height_px};
    const double half_px = 0.5 * map.spacing_px();
    for (std::int64_t y = range.y_begin; y < range.y_end; ++y) {
        for (std::int64_t x = range.x_begin; x < range.x_end; ++x) {
            const Vector2d p = map.pixel(Vector2d(double(x), double(y)));
            if (!rect.contains(p, half_px) || !whole.contains(p, -half_px)) continue;
            SeenCell& cell = cells.emplace_back();
            cell.x = static_cast<std::uint32_t>(x);
            cell.y = static_cast<std::uint32_t>(y);
            cell.nominal = code.symbol(x, y);
            cell.is_covered = meter.is_covered(p, other_print);
            offsets.push_back(meter.measure(p, levels.dot, cell));
        }
    }
    read_symbols(offsets, code.displacement, cells);
    return cells;
}

}  // namespace dotpose::calibrate
