#include "core/pose/paper_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/exponential.hpp"
#include "core/math/vectors.hpp"
#include "core/pose/dot_offsets.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::paper_step;

constexpr float kOnPlane = tuned::kOnPlane;
constexpr std::size_t kMaxDots = 1024;
constexpr std::size_t kLines = 48;  ///< maximum number of lines per direction
constexpr float kLinesPerSpacing = 2;
constexpr int kDirections = 8;
constexpr float kBehind = tuned::kBehind;

/// Sums over the dots in one part of the sheet. A dot is *coherent* if its residual is small enough
/// to be explained by a displacement of the part (tuned::kTogether).
struct PartSums {
    /// Four numbers, in this order:
    /// - number of dots,
    /// - sum of the log odds that a dot is on the plane of the whole sheet rather than at a random
    ///   position (see tuned::kOnPlane),
    /// - number of coherent dots, and
    /// - sum of the squared residuals of the coherent dots.
    Four counts;
    Four places;  ///< sums over the coherent dots: x, y, and the residuals along x and y
    /// Sums over the coherent dots: xx, xy, yy, and the cross product of position and residual.
    /// Positions are relative to the reference point.
    Four moments;

    PartSums& operator+=(const PartSums& o) {
        counts += o.counts;
        places += o.places;
        moments += o.moments;
        return *this;
    }
    PartSums less(const PartSums& o) const {
        return {counts - o.counts, places - o.places, moments - o.moments};
    }
    float seen() const { return counts[0]; }
    float on_plane() const { return counts[1]; }
    float dots() const { return counts[2]; }
    float squares() const { return counts[3]; }

    /// Returns the summed squared residuals of the coherent dots, after subtracting the best common
    /// displacement and rotation. If there are fewer than three coherent dots, subtracts nothing.
    float remaining() const {
        if (dots() < 3) return squares();
        const float by = 1 / dots();
        const float x = places[0];
        const float y = places[1];
        const float off_x = places[2];
        const float off_y = places[3];
        const float spread = moments[0] + moments[2] - by * (x * x + y * y);
        const float turned = moments[3] - by * (x * off_y - y * off_x);
        const float by_turn = spread > 1e-3F ? turned * turned / spread : 0;
        return squares() - by * (off_x * off_x + off_y * off_y) - by_turn;
    }
};

using Triple = std::array<float, 3>;

float inner_product(const Triple& a, const Triple& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Symmetric 3 x 3 matrix.
struct Symmetric3 {
    float xx, xy, xz, yy, yz, zz;

    Triple operator*(const Triple& a) const {
        return {xx * a[0] + xy * a[1] + xz * a[2], xy * a[0] + yy * a[1] + yz * a[2],
                xz * a[0] + yz * a[1] + zz * a[2]};
    }
    /// Returns the adjugate: the inverse times the determinant.
    Symmetric3 adjugate() const {
        return {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
                xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
    }
    Symmetric3 times(float by) const {
        return {by * xx, by * xy, by * xz, by * yy, by * yz, by * zz};
    }
    /// Returns the inverse, or a zero matrix if the determinant is not positive.
    Symmetric3 inverse() const {
        const Symmetric3 a = adjugate();
        const float determinant = xx * a.xx + xy * a.xy + xz * a.xz;
        return a.times(determinant > 0 ? 1 / determinant : 0);
    }
};

/// Least-squares affine map from the positions of all coherent dots to their residuals. A step
/// biases the plane that was fitted to all dots: if the step is in the middle of the view, an
/// affine change of this plane absorbs most of the step. The step and this map are therefore fitted
/// jointly.
class AffineFit {
  public:
    AffineFit() = default;
    /// `x_off` contains the sums of r, x r and y r over all coherent dots. (x, y) is the position
    /// of a dot, and r is its residual along x. `y_off` contains the same sums for the residual
    /// along y.
    AffineFit(const PartSums& all, const Triple& x_off, const Triple& y_off)
        : inverse_(Symmetric3{all.dots(), all.places[0], all.places[1], all.moments[0],
                              all.moments[1], all.moments[2]}
                       .inverse()),
          x_(inverse_ * x_off),
          y_(inverse_ * y_off),
          squares_(all.squares() - inner_product(x_, x_off) - inner_product(y_, y_off)) {}

    /// Returns the summed squared residuals of all coherent dots, after subtracting the map.
    float squares() const { return squares_; }
    /// Returns the decrease in `squares()` if a displacement of the part `beyond` is fitted
    /// together with the map. Returns 0 if the dots do not determine the displacement.
    float explained_by_displacement(const PartSums& beyond) const {
        const Triple step{beyond.dots(), beyond.places[0], beyond.places[1]};
        const float spread = step[0] - inner_product(step, inverse_ * step);
        if (!(spread > kMinSpread)) return 0;
        const float x = beyond.places[2] - inner_product(step, x_);
        const float y = beyond.places[3] - inner_product(step, y_);
        return (x * x + y * y) / spread;
    }
    /// Returns the decrease in `squares()` if a displacement and a rotation of the part `beyond`
    /// are fitted together with the map. Returns 0 if the dots do not determine the displacement.
    float explained_by_step(const PartSums& beyond) const {
        const float xx = beyond.moments[0];
        const float xy = beyond.moments[1];
        const float yy = beyond.moments[2];
        const float x = beyond.places[0];
        const float y = beyond.places[1];
        const Triple step{beyond.dots(), x, y};
        const Triple turn_x{-y, -xy, -yy};
        const Triple turn_y{x, xx, xy};
        const Triple by_step = inverse_ * step;
        const Triple seen{
            beyond.places[2] - inner_product(step, x_), beyond.places[3] - inner_product(step, y_),
            beyond.moments[3] - inner_product(turn_x, x_) - inner_product(turn_y, y_)};
        const float spread = step[0] - inner_product(step, by_step);
        const Symmetric3 normal{spread,
                                0,
                                -y - inner_product(turn_x, by_step),
                                spread,
                                x - inner_product(turn_y, by_step),
                                xx + yy - inner_product(turn_x, inverse_ * turn_x) -
                                    inner_product(turn_y, inverse_ * turn_y)};
        if (!(spread > kMinSpread)) return 0;
        return inner_product(seen, normal.inverse() * seen);
    }

  private:
    /// Minimum spread at which the dots determine a step. To compute the spread, let f be 1 for
    /// dots beyond the line and 0 for all other dots. The spread is the sum of the squared
    /// residuals of an affine fit to f. If the spread is small, an affine map can imitate the step.
    static constexpr float kMinSpread = 1;

    Symmetric3 inverse_{};
    Triple x_{};
    Triple y_{};
    float squares_ = 0;
};

class Search {
  public:
    Search(const MeasuredDots& all, const FloatPlane& plane, const PoseFit& fit,
           FloatVec reference_px)
        : variance_(fit.variance) {
        const FloatVec reference = plane_point(plane, reference_px);
        const auto count = static_cast<std::size_t>(all.count);
        const std::size_t every = count / kMaxDots + 1;
        weight_ = static_cast<float>(every);
        float outliers = 0;
        float reach = 0;  // squared distance of the farthest dot, in spacings^2
        for (std::size_t k = 0; k < count; k += every) {
            if (all.x[k] >= kNoDot_px) continue;
            DotOffset dot = dot_offset(all, k, plane, fit.displacement);
            dot.at.x -= reference.x;
            dot.at.y -= reference.y;
            reach = std::max(reach, dot.at.x * dot.at.x + dot.at.y * dot.at.y);
            if (dot.squared() > tuning::fit::kOutlier * variance_) outliers += 1;
            dots_[count_++] = Four{dot.at.x, dot.at.y, dot.residual.x, dot.residual.y};
        }
        reach_ = std::sqrt(reach);
        const float length = reach_ + 0.1F + kBehind;
        const auto wanted = static_cast<std::size_t>(kLinesPerSpacing * length);
        lines_ = std::clamp(wanted, std::size_t{4}, kLines);
        per_spacing_ = static_cast<float>(lines_) / length;
        // Log odds of an outlier, from the fraction of outliers among the dots. If outliers are
        // frequent, for example because of printed text, a single outlier is only weak evidence
        // that the paper is displaced.
        off_plane_ = natural_log((outliers + 1) / static_cast<float>(count_ + 1));
        for (std::size_t k = 0; k < count_; ++k)
            sums_[k] = sums_of(dots_[k]);
        fit_affine();
    }

    /// Returns the distance from the reference point to the farthest dot, in spacings.
    float reach() const { return reach_; }
    /// Returns the distance between adjacent lines, in spacings.
    float line_distance() const { return 1 / per_spacing_; }
    /// Replaces `best` if a line perpendicular to `direction` has a larger gain.
    void try_direction(FloatVec direction, PaperStep& best) const {
        std::array<PartSums, kLines> beyond = strips_along(direction);
        const auto consider = [&](std::size_t line, float gain) {
            if (gain <= best.gain) return;
            best = {direction, static_cast<float>(line) / per_spacing_ - kBehind, gain};
        };
        std::size_t likeliest = 0;
        float max_explained = 0;
        for (std::size_t line = lines_; --line > 0;) {
            if (line + 1 < lines_) beyond[line] += beyond[line + 1];
            const PartSums& part = beyond[line];
            if (part.seen() < tuned::kMinBeyond) continue;
            const float explained = affine_.explained_by_displacement(part);
            if (explained > max_explained) likeliest = line;
            max_explained = std::max(max_explained, explained);
            const PartSums here = all_.less(part);
            if (max_gain_of(part, here) > best.gain) consider(line, gain_of(part, here));
        }
        if (likeliest == 0) return;
        // At line `likeliest`, a displacement without rotation reduces the squared residuals the
        // most. To save time, displacements with rotation are tested only within kNear lines of
        // this line.
        constexpr std::size_t kNear = 2;
        const std::size_t last = std::min(likeliest + kNear, lines_ - 1);
        for (std::size_t line = std::max(likeliest, kNear + 1) - kNear; line <= last; ++line) {
            if (beyond[line].seen() >= tuned::kMinBeyond)
                consider(line, gain_of_step(beyond[line], best.gain));
        }
    }

  private:
    /// Returns the sums over the dots in each strip. A strip is the area between two adjacent lines
    /// that are perpendicular to `direction`. The elements beyond `lines_` are not set.
    std::array<PartSums, kLines> strips_along(FloatVec direction) const {
        std::array<PartSums, kLines> strips;
        std::fill_n(strips.begin(), lines_, PartSums{});
        const auto last = static_cast<std::int32_t>(lines_) - 1;
        for (std::size_t k = 0; k < count_; ++k) {
            const Four& dot = dots_[k];
            const float t = dot[0] * direction.x + dot[1] * direction.y + kBehind;
            const auto strip = static_cast<std::int32_t>(std::max(t, 0.0F) * per_spacing_);
            strips[static_cast<std::size_t>(std::min(strip, last))] += sums_[k];
        }
        return strips;
    }

    PartSums sums_of(const Four& dot) const {
        const float x = dot[0];
        const float y = dot[1];
        const float x_off = dot[2];
        const float y_off = dot[3];
        const float squared = x_off * x_off + y_off * y_off;
        const float on_plane = std::max(kOnPlane - squared / (2 * variance_), off_plane_);
        if (squared > tuned::kTogether * variance_) return {Four{1, on_plane}, Four{}, Four{}};
        return {Four{1, on_plane, 1, squared}, dot,
                Four{x * x, x * y, y * y, x * y_off - y * x_off}};
    }

    void fit_affine() {
        Triple x_off{};
        Triple y_off{};
        for (std::size_t k = 0; k < count_; ++k) {
            all_ += sums_[k];
            if (sums_[k].dots() == 0) continue;
            const Four& dot = dots_[k];
            const Triple place{1, dot[0], dot[1]};
            for (std::size_t i = 0; i < 3; ++i) {
                x_off[i] += place[i] * dot[2];
                y_off[i] += place[i] * dot[3];
            }
        }
        affine_ = AffineFit(all_, x_off, y_off);
    }

    /// Returns the gain of a step relative to the affine map, as a log likelihood ratio. For n
    /// coherent dots, the gain is n ln(s / r), where s and r are the summed squared residuals
    /// without and with the step. Because ln(x) <= x - 1, the gain is at most n (s - r) / r.
    /// Returns 0 without computing the logarithm if this bound is at most `min_gain`.
    float gain_of_step(const PartSums& beyond, float min_gain) const {
        const float explained = affine_.explained_by_step(beyond);
        const float remaining = affine_.squares() - explained;
        const float dots = weight_ * all_.dots();
        if (!(dots * explained > min_gain * remaining)) return 0;
        return dots * natural_log(affine_.squares() / remaining);
    }

    /// Returns the sum of the log odds of the dots in a part, for a plane fitted only to this part.
    float on_own_plane(const PartSums& part) const {
        return kOnPlane * part.dots() - part.remaining() / (2 * variance_) +
               off_plane_ * (part.seen() - part.dots());
    }

    /// Returns an upper bound on `gain_of`: the gain if separate planes fitted all coherent dots
    /// exactly.
    float max_gain_of(const PartSums& beyond, const PartSums& here) const {
        const auto max_of = [this](const PartSums& part) {
            return kOnPlane * part.dots() + off_plane_ * (part.seen() - part.dots());
        };
        return weight_ * (std::max(max_of(beyond), 0.0F) - beyond.on_plane() +
                          std::max(max_of(here) - here.on_plane(), 0.0F));
    }

    /// Returns the log likelihood ratio of two models: separate planes for the two parts, and one
    /// plane for the whole sheet. Each part has its own plane, because the plane of the whole sheet
    /// may fit neither part.
    /// - For the dots beyond the line, the log odds on their own plane are clamped to at least 0,
    ///   the value for dots at random positions.
    /// - For the dots on this side, the gain is clamped to at least 0, the value if these dots keep
    ///   the plane of the whole sheet.
    float gain_of(const PartSums& beyond, const PartSums& here) const {
        return weight_ * (std::max(on_own_plane(beyond), 0.0F) - beyond.on_plane() +
                          std::max(on_own_plane(here) - here.on_plane(), 0.0F));
    }

    /// Positions relative to the reference point, and residuals: x, y, and the residuals along x
    /// and y. The elements of this type are not cleared, which would take longer than a small
    /// search.
    std::array<Four, kMaxDots> dots_;
    std::array<PartSums, kMaxDots> sums_;
    std::size_t count_ = 0;
    PartSums all_{};
    AffineFit affine_;
    float variance_;
    /// Log odds of an outlier (see tuned::kOnPlane). Also the lower limit of the log odds of any
    /// dot.
    float off_plane_;
    float weight_ = 1;  ///< number of dots that each sample represents
    float reach_ = 0;
    std::size_t lines_ = 0;
    float per_spacing_ = 0;  ///< number of lines per spacing
};

FloatVec turned(FloatVec v, float c, float s) {
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace

PaperStep find_paper_step(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
                          FloatVec reference_px) {
    const Search search(dots, plane, fit, reference_px);
    PaperStep best;
    constexpr float kSin = 0.70710678F;  // sine and cosine of 45 degrees
    FloatVec direction{1, 0};
    for (int i = 0; i < kDirections; ++i) {
        search.try_direction(direction, best);
        direction = turned(direction, kSin, kSin);
    }
    // Refines the direction of the line only if its gain is at least kPossible / 2. A smaller gain
    // would have to more than double to reach kPossible, and a small rotation of the line rarely
    // changes it that much.
    if (best.gain < PaperStep::kPossible / 2) return best;
    // Ends when a further rotation would move the farthest part of the line by at most the distance
    // to the next line.
    constexpr int kMaxHalvings = 5;
    float s = kSin;
    for (int n = 0; n < kMaxHalvings && s / 2 * search.reach() > search.line_distance(); ++n) {
        s /= 2;
        const float c = std::sqrt(1 - s * s);
        const FloatVec around = best.direction;
        search.try_direction(turned(around, c, s), best);
        search.try_direction(turned(around, c, -s), best);
    }
    return best;
}

}  // namespace dotpose::core
