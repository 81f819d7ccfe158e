#include "core/lattice/grid_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/symmetric2.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::outwards;

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

}  // namespace

bool GridFit::start() {
    for (int round = 0; round < 2; ++round)
        if (!fit_to_intersections()) return false;
    const float mean_square = sums_.squares / sums_.used;
    if (mean_square < tuning::kMaxUndisplaced) return false;
    displacement_ =
        std::clamp(std::sqrt(mean_square), tuned::kMinDisplacement, tuned::kMaxDisplacement);
    max_off_ = std::min(tuned::kMaxOffsetPart * displacement_, tuned::kMaxOffset);
    return true;
}

bool GridFit::grow() {
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

bool GridFit::fit_to_intersections() {
    return fit({reach_px_, tuned::kFirstMaxOffset, 0, needs_perspective()});
}

bool GridFit::fit_to_places() {
    return fit({reach_px_, max_off_, displacement_, needs_perspective()}) &&
           fraction() >= tuned::kMinFraction;
}

bool GridFit::fit(const CellPass& pass) {
    sums_ = kernels_.sum_cells(dots_, plane_, pass);
    return sums_.used >= tuned::kMinUsed && solve_plane(sums_, pass.with_perspective, plane_);
}

bool GridFit::is_good() const {
    return fraction() > tuned::kGoodFraction && variance() < tuned::kGoodVariance;
}

bool GridFit::is_plausible() const {
    const float spacing = spacing_px(plane_);
    const float fold = (std::abs(plane_.tilt_x) + std::abs(plane_.tilt_y)) * full_reach_px_;
    return spacing > tuned::kMinSpacing * first_spacing_px_ &&
           spacing < tuned::kMaxSpacing * first_spacing_px_ && fold < tuned::kMaxFold;
}

}  // namespace dotpose::core
