#include "calibrate/print_dots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrate/least_squares.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

constexpr std::array kSymbols = {Symbol::up, Symbol::left, Symbol::right, Symbol::down};
/// Greatest distance of ink from its intersection, in spacings; farther ink belongs to another dot.
constexpr double kFarthest = 0.42;
/// Least darkness of a dot, as a share of that of a typical one.
constexpr double kLeastShare = 0.35;
/// Share of a dot's darkness that is subtracted before its centroid is computed: noise and ringing
/// of JPEG.
constexpr double kFloorShare = 0.15;
/// Radius, in spacings, within which a dot is summed up: half the way to the nearest possible dot.
constexpr double kReach = 1.0 / 3;
/// Other print, such as text or pictures, is assumed where a cell's border is darker than this
/// share of a dot's darkness, and darker than this number of standard deviations of blank paper.
constexpr double kOtherPrintShare = 0.35;
constexpr double kOtherPrint_sigmas = 6;
constexpr int kCentrings = 4;
constexpr double kCentred_px = 0.01;
constexpr int kLeastToFit = 30;

/// Returns the median; reorders the values.
double median(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Returns the mean of the middle half of the values.
double middle_mean(std::vector<double>& values) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
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

/// Returns the cells that may lie in a rectangle.
CellRange cells_in(const PixelRect& rect, const LocalMap& map) {
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

/// Measures dots in one tile, relative to its paper.
class Meter {
  public:
    Meter(const ImageView& scan, const LocalMap& map, double displacement, double paper)
        : scan_(scan),
          map_(map),
          cells_per_px_(map.px_per_cell.inverse()),
          displacement_(displacement),
          reach_px_(kReach * map.spacing_px()),
          inner_px2_(std::pow(std::max(reach_px_ - 0.5, 0.0), 2)),
          outer_px2_(std::pow(reach_px_ + 0.5, 2)),
          sample_px_(0.5 * displacement * map.spacing_px()),
          paper_(paper),
          per_paper_(1 / paper) {}

    /// Returns the greatest darkness among the four places of a dot; sets `place_px` to that place.
    double likeliest(const Vector2d& intersection_px, Vector2d& place_px) const {
        double best = -1e9;
        for (const Symbol symbol : kSymbols) {
            const Vector2d offset(dx(symbol), dy(symbol));
            const Vector2d place = intersection_px + map_.px_per_cell * (displacement_ * offset);
            const double strength = strength_at(place);
            if (strength <= best) continue;
            best = strength;
            place_px = place;
        }
        return best;
    }

    /// Measures the dot near `place_px`, after moving to its centroid from there.
    void measure(const Vector2d& intersection_px, Vector2d place_px, double strength,
                 SeenCell& cell) const {
        double moved_px = 1;
        for (int i = 0; i < kCentrings && moved_px > kCentred_px; ++i) {
            const Vector2d before = place_px;
            place_px = centroid(place_px, kFloorShare * strength);
            moved_px = (place_px - before).norm();
        }
        const Vector2d offset = cells_per_px_ * (place_px - intersection_px);
        cell.strength = static_cast<float>(strength_at(place_px) / strength);
        cell.has_dot =
            double(cell.strength) >= kLeastShare && offset.cwiseAbs().maxCoeff() <= kFarthest;
        if (!cell.has_dot) return;
        const bool is_horizontal = std::abs(offset.x()) > std::abs(offset.y());
        cell.read = is_horizontal ? (offset.x() > 0 ? Symbol::right : Symbol::left)
                                  : (offset.y() > 0 ? Symbol::down : Symbol::up);
        cell.u_px = static_cast<float>(place_px.x());
        cell.v_px = static_cast<float>(place_px.y());
        cell.paper = static_cast<float>(paper_);
        cell.peak = static_cast<float>(darkness_at(scan_, place_px, paper_));
        cell.mass_px2 = static_cast<float>(mass(place_px));
    }

    /// Whether the border of a cell is not blank: darker by `least_darkness` or, where most of the
    /// tile is filled with grey, lighter. The middles of the cell's sides do not count, because
    /// swollen dots may run together there.
    bool is_covered(const Vector2d& cell, double least_darkness) const {
        for (const double along : {-0.5, -0.25, 0.25, 0.5}) {
            for (const double across : {-0.5, 0.5}) {
                for (const Vector2d& step : {Vector2d(along, across), Vector2d(across, along)}) {
                    const Vector2d p = map_.pixel(cell + step);
                    const double darkness = darkness_at(scan_, p, paper_);
                    if (std::abs(darkness) > least_darkness) return true;
                }
            }
        }
        return false;
    }

  private:
    /// Returns the mean darkness of five points around `p`.
    double strength_at(const Vector2d& p) const {
        double sum = darkness_at(scan_, p, paper_);
        for (const double step : {-sample_px_, sample_px_}) {
            sum += darkness_at(scan_, p + Vector2d(step, 0), paper_);
            sum += darkness_at(scan_, p + Vector2d(0, step), paper_);
        }
        return sum / 5;
    }

    /// Visits the pixels within reach of a point, with their darkness and a weight that fades out
    /// over the last pixel, so that sums change smoothly with the point.
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
            const double share = weight * std::max(darkness - floor, 0.0);
            sum += share;
            moment += share * Vector2d(u, v);
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
    const LocalMap& map_;
    Eigen::Matrix2d cells_per_px_;
    double displacement_;
    double reach_px_;
    double inner_px2_;  ///< squared distances between which pixels count in part
    double outer_px2_;
    double sample_px_;
    double paper_;
    double per_paper_;
};

/// Sets the level of the paper, from the corners of the cells, which no dot comes near, and its
/// noise.
void measure_paper(const ImageView& scan, const PixelRect& rect, const LocalMap& map,
                   SeenTile& tile) {
    const CellRange range = cells_in(rect, map);
    std::vector<double> levels;
    for (std::int64_t y = range.y_begin; y < range.y_end; ++y) {
        for (std::int64_t x = range.x_begin; x < range.x_end; ++x) {
            const auto corner = map.pixel(Vector2d(double(x) + 0.5, double(y) + 0.5));
            if (rect.contains(corner, 0)) levels.push_back(level_at(scan, corner));
        }
    }
    tile.paper = middle_mean(levels);
    if (tile.paper <= 0) return;
    // Half of a normal distribution lies within 0.6745 standard deviations.
    constexpr double kSigmaPerQuartiles = 1 / (2 * 0.6745);
    const std::size_t quarter = levels.size() / 4;
    tile.noise =
        kSigmaPerQuartiles * (levels[levels.size() - 1 - quarter] - levels[quarter]) / tile.paper;
}

}  // namespace

Symbol Code::symbol(std::int64_t x, std::int64_t y) const {
    return symbol_at(profile, {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)},
                     section);
}

Vector2d Code::dot_cell(std::int64_t x, std::int64_t y, Symbol symbol) const {
    return {static_cast<double>(x) + displacement * dx(symbol),
            static_cast<double>(y) + displacement * dy(symbol)};
}

double darkness_at(const ImageView& scan, const Vector2d& pixel, double paper) {
    return 1 - level_at(scan, pixel) / paper;
}

SeenTile measure_tile(const ImageView& scan, const PixelRect& rect, const LocalMap& map,
                      const Code& code, std::optional<double> strength) {
    SeenTile tile;
    measure_paper(scan, rect, map, tile);
    if (tile.paper <= 0) return tile;
    const Meter meter(scan, map, code.displacement, tile.paper);
    const CellRange range = cells_in(rect, map);
    const PixelRect whole{0, 0, scan.width_px, scan.height_px};
    const double half_px = 0.5 * map.spacing_px();
    std::vector<Vector2d> places_px;
    std::vector<double> strengths;
    for (std::int64_t y = range.y_begin; y < range.y_end; ++y) {
        for (std::int64_t x = range.x_begin; x < range.x_end; ++x) {
            const Vector2d p = map.pixel(Vector2d(double(x), double(y)));
            if (!rect.contains(p, half_px) || !whole.contains(p, -half_px)) continue;
            SeenCell& cell = tile.cells.emplace_back();
            cell.x = static_cast<std::uint32_t>(x);
            cell.y = static_cast<std::uint32_t>(y);
            cell.nominal = code.symbol(x, y);
            strengths.push_back(meter.likeliest(p, places_px.emplace_back()));
        }
    }
    tile.strength = median(strengths);
    const double expected = strength.value_or(tile.strength);
    // However great the noise, print as dark as a dot counts as other print.
    const double other_print =
        std::max(kOtherPrintShare * expected, std::min(kOtherPrint_sigmas * tile.noise, expected));
    for (std::size_t i = 0; i < tile.cells.size(); ++i) {
        SeenCell& cell = tile.cells[i];
        meter.measure(map.pixel(Vector2d(cell.x, cell.y)), places_px[i], expected, cell);
        cell.is_covered = meter.is_covered(Vector2d(cell.x, cell.y), other_print);
        tile.dots += cell.has_dot ? 1 : 0;
        tile.right += cell.is_right() ? 1 : 0;
    }
    return tile;
}

std::optional<LocalMap> fit_map(const SeenTile& tile, const Code& code,
                                const Perspective& perspective) {
    if (tile.right < kLeastToFit) return std::nullopt;
    Vector2d middle = Vector2d::Zero();
    for (const SeenCell& cell : tile.cells) {
        if (cell.is_right()) middle += code.dot_cell(cell.x, cell.y, cell.nominal) / tile.right;
    }
    LocalMap map;
    map.centre_cell = middle;
    map.perspective_per_cell = perspective.at(middle);
    // With the perspective known, the map is linear in the cells as they would be without it.
    const auto without = [&](const SeenCell& cell) {
        const Vector2d d = code.dot_cell(cell.x, cell.y, cell.nominal) - middle;
        return Vector2d(d / (1 + map.perspective_per_cell.dot(d)));
    };
    NormalEquations along_u(3);
    NormalEquations along_v(3);
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const SeenCell& cell : tile.cells) {
        if (!cell.is_right()) continue;
        const Vector2d step = without(cell);
        const std::array row{step.x(), step.y(), 1.0};
        along_u.add(row, double(cell.u_px));
        along_v.add(row, double(cell.v_px));
        spread += step * step.transpose();
    }
    // A single line of dots does not determine the map across it.
    if (spread.determinant() < 1e-3 * spread.trace() * spread.trace()) return std::nullopt;
    const std::vector<double> u = along_u.solution();
    const std::vector<double> v = along_v.solution();
    map.px_per_cell << u[0], u[1], v[0], v[1];
    map.centre_px = {u[2], v[2]};
    return map;
}

}  // namespace dotpose::calibrate
