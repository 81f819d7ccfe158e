#include "core/lattice/outwards.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/lattice/tuning.hpp"
#include "core/math/float_plane.hpp"
#include "core/math/symmetric2.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::outwards;

/// Returns the pair of plane waves that fits the central dots best. Returns nullopt if the waves
/// are too weak, the spacing is out of range, or there are too few central dots.
std::optional<Waves> find_waves(const Kernels& kernels, const Patch& patch, const PatchView& view) {
    const float spacing = view.spacing_px;
    const PatchDots& dots = patch.dots;
    const auto scale = static_cast<float>(patch.scale);
    if (spacing < tuned::kFinest_px * scale || spacing > tuned::kCoarsest_px * scale) return {};
    // The central dots are in a disc with the area of `central_dots` cells.
    const float radius_2 = view.central_dots * spacing * spacing / 3.14159265F;
    alignas(64) std::array<float, tuned::kMaxCentralDots + 8> x;
    alignas(64) std::array<float, tuned::kMaxCentralDots + 8> y;
    std::size_t count = 0;
    for (std::size_t i = 0;
         i < static_cast<std::size_t>(dots.count) && count < tuned::kMaxCentralDots; ++i) {
        x[count] = dots.x[i];
        y[count] = dots.y[i];
        count += dots.x[i] * dots.x[i] + dots.y[i] * dots.y[i] < radius_2 ? 1 : 0;
    }
    if (count < tuned::kMinCentralDots) return {};
    std::fill_n(x.begin() + count, 8, kNoDot_px);
    std::fill_n(y.begin() + count, 8, 0.0F);
    const float unit = static_cast<float>(count) * static_cast<float>(count);
    if (view.is_skewed) {
        const Waves waves = kernels.strongest_skewed_waves(x.data(), y.data(),
                                                           static_cast<int>(count), 1 / spacing);
        return waves.power < tuned::kFaintWaves * unit ? std::nullopt : std::optional(waves);
    }
    Waves best;
    // Also tries other spacings, because missing dots increase the estimated spacing, and false
    // dots reduce it.
    for (const float by : {1.0F, 0.93F, 1.07F, 0.87F, 1.14F, 0.81F}) {
        const Waves waves =
            kernels.strongest_waves(x.data(), y.data(), static_cast<int>(count), by / spacing);
        if (waves.power > best.power) best = waves;
        if (best.power > tuned::kClearWaves * unit) break;
    }
    if (best.power < tuned::kFaintWaves * unit) return {};
    return best;
}

/// Returns the phase of wave i in cycles, in [-1/2, 1/2]. The error is at most 1/1000 cycle.
float phase_in_cycles(const Waves& waves, std::size_t i) {
    const float x = std::abs(waves.phase_cos[i]);
    const float y = std::abs(waves.phase_sin[i]);
    const float ratio = std::min(x, y) / std::max({x, y, 1e-20F});
    const float octant = ratio / (6.2831853F + 1.7593F * ratio * ratio);
    const float quarter = y > x ? 0.25F - octant : octant;
    const float half = waves.phase_cos[i] < 0 ? 0.5F - quarter : quarter;
    return waves.phase_sin[i] < 0 ? -half : half;
}

FloatPlane plane_from_waves(const Waves& waves) {
    FloatPlane plane;
    plane.at_x = -phase_in_cycles(waves, 0);
    plane.at_y = -phase_in_cycles(waves, 1);
    plane.du_x = waves.kx[0];
    plane.dv_x = waves.ky[0];
    plane.du_y = waves.kx[1];
    plane.dv_y = waves.ky[1];
    return plane;
}

/// Inverse of the normal matrix for three unknowns. The elements of the normal matrix are the sums
/// of 1, x, y, xx, xy and yy over the dots used in the fit.
struct Inverse {
    std::array<std::array<float, 3>, 3> m;
    bool is_regular = false;

    explicit Inverse(const std::array<float, 6>& one) {
        const auto& [n, x, y, xx, xy, yy] = one;
        const float a = yy * n - y * y;
        const float b = x * y - xy * n;
        const float c = xy * y - x * yy;
        const float determinant = xx * a + xy * b + x * c;
        is_regular = determinant > 1e-4F * xx * yy * n;
        if (!is_regular) return;
        const float over = 1 / determinant;
        m = {{{a * over, b * over, c * over},
              {b * over, (xx * n - x * x) * over, (xy * x - xx * y) * over},
              {c * over, (xy * x - xx * y) * over, (xx * yy - xy * xy) * over}}};
    }
    std::array<float, 3> operator()(const std::array<float, 3>& v) const {
        std::array<float, 3> r;
        for (std::size_t i = 0; i < 3; ++i)
            r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
        return r;
    }
};

float inner(const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Fits a plane to cells (i, j) at image points (x, y) by least squares:
///   i (1 + g x + h y) = a x + b y + c
///   j (1 + g x + h y) = d x + e y + f
/// Eliminating a to f leaves two equations for g and h. Without perspective, g = h = 0. Returns
/// false if the dots do not determine the plane.
bool solve_plane(const CellSums& sums, bool with_perspective, FloatPlane& plane) {
    const Inverse inverse(sums.one);
    if (!inverse.is_regular) return false;
    const auto right_of = [](const std::array<float, 6>& s) {
        return std::array{s[1], s[2], s[0]};
    };
    // `with_x(sums.i)` returns the sums of i * x^2, i * x * y and i * x. `with_y(sums.i)` returns
    // the sums of i * x * y, i * y^2 and i * y. The results for `sums.j` contain j instead of i.
    const auto with_x = [](const std::array<float, 6>& s) { return std::array{s[3], s[4], s[1]}; };
    const auto with_y = [](const std::array<float, 6>& s) { return std::array{s[4], s[5], s[2]}; };
    std::array<float, 3> i = inverse(right_of(sums.i));
    std::array<float, 3> j = inverse(right_of(sums.j));
    float g = 0;
    float h = 0;
    if (with_perspective) {
        const auto ix = inverse(with_x(sums.i));
        const auto iy = inverse(with_y(sums.i));
        const auto jx = inverse(with_x(sums.j));
        const auto jy = inverse(with_y(sums.j));
        const Symmetric2<float> left{
            sums.square[3] - inner(ix, with_x(sums.i)) - inner(jx, with_x(sums.j)),
            sums.square[4] - inner(ix, with_y(sums.i)) - inner(jx, with_y(sums.j)),
            sums.square[5] - inner(iy, with_y(sums.i)) - inner(jy, with_y(sums.j))};
        const float right_x =
            inner(ix, right_of(sums.i)) + inner(jx, right_of(sums.j)) - sums.square[1];
        const float right_y =
            inner(iy, right_of(sums.i)) + inner(jy, right_of(sums.j)) - sums.square[2];
        const float determinant = left.determinant();
        if (!(determinant > 1e-4F * left.xx * left.yy)) return false;
        const auto [x, y] = left.solve_scaled(right_x, right_y);
        g = x / determinant;
        h = y / determinant;
        for (std::size_t k = 0; k < 3; ++k) {
            i[k] += g * ix[k] + h * iy[k];
            j[k] += g * jx[k] + h * jy[k];
        }
    }
    plane = {i[2], j[2], i[0] - i[2] * g, j[0] - j[2] * g, i[1] - i[2] * h, j[1] - j[2] * h, g,
             h,    0};
    return true;
}

/// Returns the factor by which the reach of a fit changes for the next round. `fraction` is the
/// fraction of the dots within the current reach that are near one of the four dot positions of
/// their cell.
float growth(float fraction) {
    if (fraction > tuned::kGoodFraction) return tuned::kGoodGrowth;
    return fraction > tuned::kFairFraction ? tuned::kFairGrowth : tuned::kPoorGrowth;
}

/// Detects that further rounds of a fit would only repeat the last planes.
class Settling {
  public:
    /// Adds the sums of a round. Returns true if as many dots were seen and used two rounds before,
    /// and the reach is not larger than in the last round. The reach of a settled fit may alternate
    /// between two values. The plane for the smaller reach is more precise.
    bool is_settled_after(const CellSums& sums) {
        const bool is_settled =
            sums.used == before_.used && sums.seen == before_.seen && sums.seen <= last_.seen;
        before_ = last_;
        last_ = {sums.used, sums.seen};
        return is_settled;
    }

  private:
    struct Counts {
        float used = 0;
        float seen = 0;
    };
    Counts last_;
    Counts before_;  ///< counts of the round before the last one
};

/// Fits the plane of a grid to the dots around the origin, in rounds. Each round assigns the dots
/// to cells by the plane of the previous round.
class GridFit {
  public:
    GridFit(const Kernels& kernels, const PatchDots& dots, const FloatPlane& first_plane,
            float full_reach_px)
        : kernels_(kernels),
          dots_(dots),
          plane_(first_plane),
          first_spacing_px_(spacing_px(first_plane)),
          full_reach_px_(full_reach_px),
          reach_px_(tuned::kFirstReach * first_spacing_px_) {}

    /// Fits the plane to the dots nearest the origin, and estimates the displacement of the dots.
    /// Returns false if there are too few dots, or if they are not displaced.
    bool start() {
        for (int round = 0; round < 2; ++round)
            if (!fit_to_intersections()) return false;
        constexpr float kUndisplaced = 1.0F / 256;
        const float mean_square = sums_.squares / sums_.used;
        if (mean_square < kUndisplaced) return false;
        displacement_ =
            std::clamp(std::sqrt(mean_square), tuned::kMinDisplacement, tuned::kMaxDisplacement);
        max_off_ = std::min(tuned::kMaxOffsetPart * displacement_, tuned::kMaxOffset);
        return true;
    }

    /// Increases the reach of the fit until it is good and covers the whole patch, or settles.
    /// Returns false if too few dots are near a dot position, or if a plane is not plausible.
    ///
    /// A fit may settle at a false plane that assigns outer dots to false dot positions. If a fit
    /// settles before it is good, it is continued once from a plane that is fitted to
    /// intersections. Without this step, 34 of the 4,000 planes in the test of small views are
    /// false.
    bool grow() {
        Settling settling;
        bool is_continued = false;
        for (int round = 1;; ++round) {
            if (!fit_to_places() || !is_plausible()) return false;
            const bool covers_all = reach_px_ >= full_reach_px_;
            if ((is_good() && covers_all) || round == tuned::kMaxRounds) return true;
            if (!is_good() && settling.is_settled_after(sums_)) {
                if (is_continued) return true;
                is_continued = true;
                if (!fit_to_intersections()) return false;
                continue;
            }
            reach_px_ = std::min(std::max(reach_px_ * growth(fraction()), 4 * first_spacing_px_),
                                 full_reach_px_);
        }
    }

    /// Returns true if the fit covers enough of the patch for reading bits. Graphics may prevent
    /// the fit from covering the whole patch, so a fit to the dots within five spacings of the
    /// origin suffices.
    bool is_sufficient() const {
        return reach_px_ >= std::min(full_reach_px_, 5 * first_spacing_px_) && fraction() >= 0.5F;
    }

    PatchGrid grid() const {
        return {plane_, displacement_, variance(),
                sums_.used * max_off_ * max_off_ - sums_.squares};
    }

  private:
    /// Fits the plane as if all dots were on their intersections, so displacements act as noise.
    bool fit_to_intersections() {
        return fit({reach_px_, tuned::kFirstMaxOffset, 0, needs_perspective()});
    }
    /// Assigns each dot to the nearest of the four dot positions of its cell, so displacements do
    /// not act as noise.
    bool fit_to_places() {
        return fit({reach_px_, max_off_, displacement_, needs_perspective()}) &&
               fraction() >= tuned::kMinFraction;
    }
    bool fit(const CellPass& pass) {
        sums_ = kernels_.sum_cells(dots_, plane_, pass);
        return sums_.used >= tuned::kMinUsed && solve_plane(sums_, pass.with_perspective, plane_);
    }
    bool needs_perspective() const { return reach_px_ > 4 * first_spacing_px_; }

    bool is_good() const {
        return fraction() > tuned::kGoodFraction && variance() < tuned::kGoodVariance;
    }
    /// Fraction of the dots within the reach that are near a dot position.
    float fraction() const { return sums_.used / std::max(sums_.seen, 1.0F); }
    /// Variance of the distances from the used dots to their dot positions, per axis, in
    /// spacings^2.
    float variance() const { return sums_.squares / (2 * sums_.used); }

    /// Returns true if the spacing is near the first spacing, and the perspective divisor differs
    /// from 1 by less than kMaxFold wherever |x| and |y| are at most the full reach.
    bool is_plausible() const {
        const float spacing = spacing_px(plane_);
        const float fold = (std::abs(plane_.tilt_x) + std::abs(plane_.tilt_y)) * full_reach_px_;
        return spacing > tuned::kMinSpacing * first_spacing_px_ &&
               spacing < tuned::kMaxSpacing * first_spacing_px_ && fold < tuned::kMaxFold;
    }

    const Kernels& kernels_;
    const PatchDots& dots_;
    FloatPlane plane_;
    float first_spacing_px_;
    float full_reach_px_;
    float reach_px_;          ///< maximum distance from the origin to a dot, along each axis
    float displacement_ = 0;  ///< in spacings
    float max_off_ = 0;       ///< see `CellPass::max_off`
    CellSums sums_;           ///< sums of the last round
};

/// The local density of the dots around a dot is measured by the distance from this dot to its
/// kNearest-th nearest neighbour. The first estimate of the grid spacing is computed from the
/// smallest of these distances.
constexpr std::size_t kNearest = 20;

/// Squared distances from one dot to all dots of a patch, in px^2.
using SquaredDistances = std::array<float, PatchDots::kMax>;

/// Returns the squared distance from the dot at `of` to its kNearest-th nearest neighbour, in px^2.
/// Overwrites `squares`.
float squared_reach_of_nearest(const PatchDots& dots, FloatVec of, SquaredDistances& squares) {
    const auto count = static_cast<std::size_t>(dots.count);
    for (std::size_t i = 0; i < count; ++i) {
        const float x = dots.x[i] - of.x;
        const float y = dots.y[i] - of.y;
        squares[i] = x * x + y * y;
    }
    const auto farthest = squares.begin() + kNearest;
    std::nth_element(squares.begin(), farthest, squares.begin() + count);
    return *farthest;
}

}  // namespace

PatchView whole_view(const Patch& patch) {
    const auto scale = static_cast<float>(patch.scale);
    const float area =
        static_cast<float>((patch.width_px - 4) * (patch.height_px - 4)) * scale * scale;
    return {std::sqrt(area / static_cast<float>(std::max(patch.dots.count, 1))),
            static_cast<float>(std::max(patch.width_px, patch.height_px) * patch.scale) / 2 + 1};
}

bool move_origin_to_densest(Patch& patch, PatchView& view, FloatVec& from_middle_px) {
    PatchDots& dots = patch.dots;
    const int count = dots.count;
    if (count < tuned::kMinDots) return false;
    // Limits on the number of dots that are tested as origins. Testing one dot takes time
    // proportional to the number of dots, so fewer dots are tested in noisy patches, which contain
    // many dots. The number of computed distances is limited to about kMaxDistances, but at least
    // kMinCandidates dots are tested.
    constexpr int kMaxCandidates = 64;
    constexpr int kMinCandidates = 16;
    constexpr int kMaxDistances = 32768;
    const int candidates = std::clamp(kMaxDistances / count, kMinCandidates, kMaxCandidates);
    const int step = count / candidates + 1;
    float min_reach_2 = kNoDot_px;
    SquaredDistances squares{};
    for (int i = 0; i < count; i += step) {
        const auto k = static_cast<std::size_t>(i);
        const FloatVec candidate{dots.x[k], dots.y[k]};
        const float reach_2 = squared_reach_of_nearest(dots, candidate, squares);
        if (reach_2 >= min_reach_2) continue;
        min_reach_2 = reach_2;
        // Uses whole pixels, so a plane can be moved to this origin without rounding errors.
        from_middle_px = {std::floor(candidate.x), std::floor(candidate.y)};
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        dots.x[i] -= from_middle_px.x;
        dots.y[i] -= from_middle_px.y;
    }
    view = whole_view(patch);
    view.full_reach_px += std::max(std::abs(from_middle_px.x), std::abs(from_middle_px.y));
    // A disc with n dots has about the area of n cells.
    view.spacing_px = std::sqrt(3.14159265F * min_reach_2 / (kNearest + 0.5F));
    return true;
}

bool find_grid(const Kernels& kernels, const Patch& patch, const PatchView& view, PatchGrid& grid) {
    if (patch.dots.count < view.min_dots) return false;
    const std::optional<Waves> waves = find_waves(kernels, patch, view);
    if (!waves) return false;
    GridFit fit(kernels, patch.dots, plane_from_waves(*waves), view.full_reach_px);
    if (!fit.start() || !fit.grow() || !fit.is_sufficient()) return false;
    grid = fit.grid();
    return true;
}

}  // namespace dotpose::core
