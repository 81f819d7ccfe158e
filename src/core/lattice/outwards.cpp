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

/// Returns true if the spacing is near `first_spacing`, and the perspective divisor differs from 1
/// by less than kMaxFold wherever |x| and |y| are at most `reach` px.
bool is_plausible(const FloatPlane& plane, float first_spacing, float reach) {
    const float spacing = spacing_px(plane);
    const float fold = (std::abs(plane.tilt_x) + std::abs(plane.tilt_y)) * reach;
    return spacing > tuned::kMinSpacing * first_spacing &&
           spacing < tuned::kMaxSpacing * first_spacing && fold < tuned::kMaxFold;
}

/// Returns the factor by which `CellPass::reach_px` changes for the next round. `fraction` is the
/// fraction of the dots within the current reach that are near one of the four dot positions of
/// their cell.
float growth(float fraction) {
    if (fraction > tuned::kGoodFraction) return tuned::kGoodGrowth;
    return fraction > tuned::kFairFraction ? tuned::kFairGrowth : tuned::kPoorGrowth;
}

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
    FloatPlane& plane = grid.grid_from_image;
    plane = plane_from_waves(*waves);
    const float spacing = spacing_px(plane);
    const float full = view.full_reach_px;
    // The first rounds fit the plane as if all dots were on their intersections, so displacements
    // act as noise.
    CellPass pass{tuned::kFirstReach * spacing, tuned::kFirstMaxOffset, 0};
    CellSums sums;
    for (int round = 0; round < 2; ++round) {
        sums = kernels.sum_cells(patch.dots, plane, pass);
        if (sums.used < tuned::kMinUsed || !solve_plane(sums, false, plane)) return false;
    }
    constexpr float kUndisplaced = 1.0F / 256;
    const float mean_square = sums.squares / sums.used;
    if (mean_square < kUndisplaced) return false;
    grid.displacement =
        std::clamp(std::sqrt(mean_square), tuned::kMinDisplacement, tuned::kMaxDisplacement);
    // Subsequent rounds assign each dot to the nearest of the four dot positions of its cell, so
    // displacements no longer act as noise.
    pass.displacement = grid.displacement;
    pass.max_off = std::min(tuned::kMaxOffsetPart * grid.displacement, tuned::kMaxOffset);
    for (int round = 0; round < tuned::kMaxRounds; ++round) {
        pass.with_perspective = pass.reach_px > 4 * spacing;
        sums = kernels.sum_cells(patch.dots, plane, pass);
        const float fraction = sums.used / std::max(sums.seen, 1.0F);
        if (sums.used < tuned::kMinUsed || fraction < tuned::kMinFraction ||
            !solve_plane(sums, pass.with_perspective, plane))
            return false;
        if (!is_plausible(plane, spacing, full)) return false;
        if (pass.reach_px >= full &&
            (fraction > tuned::kGoodFraction || round + 1 == tuned::kMaxRounds))
            break;
        pass.reach_px = std::min(std::max(pass.reach_px * growth(fraction), 4 * spacing), full);
    }
    // Graphics may prevent the fit from covering the whole patch, so a fit to the dots within five
    // spacings of the origin is also accepted. Such a fit is sufficient for reading bits.
    if (pass.reach_px < std::min(full, 5 * spacing) || sums.used < 0.5F * sums.seen) return false;
    grid.variance = sums.squares / (2 * sums.used);
    grid.agreement = sums.used * pass.max_off * pass.max_off - sums.squares;
    return true;
}

}  // namespace dotpose::core
