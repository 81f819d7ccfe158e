#include "core/pose/slip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose/dot_offsets.hpp"

namespace dotpose::core {
namespace {

/// What a dot says for a plane on which it lies, at most, and against one on which it does not, as
/// natural logarithms of odds against dots that lie anywhere in their cells.
constexpr float kOnPlane = 5;
constexpr float kOffPlane = -4.5F;
/// Dots of one part lie within so many deviations of where another has them, squared, for its
/// displacement to be told from them.
constexpr float kTogether = 36;
constexpr std::size_t kMostDots = 2048;
constexpr std::size_t kLines = 64;  ///< in each direction
constexpr int kDirections = 32;
/// Spacings by which the reference point may lie beyond the line.
constexpr float kBehind = 0.5F;
constexpr float kFewestBeyond = 12;

/// Sums over dots of one part.
struct PartSums {
    float seen = 0;      ///< those as good as on the plane or not
    float on_plane = 0;  ///< what they say for the plane as it is
    float dots = 0;      ///< of those that lie together
    float x = 0;
    float y = 0;
    float off_x = 0;
    float off_y = 0;
    float squares = 0;  ///< of the distances from the reference point
    float off_squares = 0;
    float turned = 0;

    PartSums& operator+=(const PartSums& o) {
        seen += o.seen;
        on_plane += o.on_plane;
        dots += o.dots;
        x += o.x;
        y += o.y;
        off_x += o.off_x;
        off_y += o.off_y;
        squares += o.squares;
        off_squares += o.off_squares;
        turned += o.turned;
        return *this;
    }
    PartSums less(const PartSums& o) const {
        return {seen - o.seen,
                on_plane - o.on_plane,
                dots - o.dots,
                x - o.x,
                y - o.y,
                off_x - o.off_x,
                off_y - o.off_y,
                squares - o.squares,
                off_squares - o.off_squares,
                turned - o.turned};
    }
};

/// The squared distances that are left if a part moved and turned as a whole.
float left_of(const PartSums& part) {
    if (part.dots < 3) return part.off_squares;
    const float by = 1 / part.dots;
    const FloatVec middle{part.x * by, part.y * by};
    const FloatVec off{part.off_x * by, part.off_y * by};
    const float spread = part.squares - part.dots * (middle.x * middle.x + middle.y * middle.y);
    const float turned = part.turned - part.dots * (middle.x * off.y - middle.y * off.x);
    const float by_turn = spread > 1e-3F ? turned * turned / spread : 0;
    return part.off_squares - part.dots * (off.x * off.x + off.y * off.y) - by_turn;
}

class Search {
  public:
    Search(const MeasuredDots& all, const FloatPlane& plane, const PoseFit& fit,
           FloatVec reference_px)
        : variance_(fit.variance) {
        const FloatVec reference = plane_point(plane, reference_px);
        const auto count = static_cast<std::size_t>(all.count);
        const std::size_t every = count / kMostDots + 1;
        weight_ = static_cast<float>(every);
        for (std::size_t k = 0; k < count; k += every) {
            if (all.x[k] >= kNoDot_px) continue;
            DotOffset& dot = dots_[count_++];
            dot = dot_offset(all, k, plane, fit.displacement);
            dot.at.x -= reference.x;
            dot.at.y -= reference.y;
            reach_ = std::max(reach_, dot.at.x * dot.at.x + dot.at.y * dot.at.y);
        }
        reach_ = std::sqrt(reach_) + 0.1F;
    }

    /// The best of the lines at right angles to a direction, if it is better than another.
    void try_direction(FloatVec direction, Slip& best) const {
        std::array<PartSums, kLines> strips{};
        const float per_spacing = static_cast<float>(kLines) / (reach_ + kBehind);
        PartSums all;
        for (std::size_t k = 0; k < count_; ++k) {
            const PartSums dot = sums_of(dots_[k]);
            const float t = dots_[k].at.x * direction.x + dots_[k].at.y * direction.y + kBehind;
            const auto strip = static_cast<std::size_t>(std::max(t, 0.0F) * per_spacing);
            strips[std::min(strip, kLines - 1)] += dot;
            all += dot;
        }
        PartSums beyond;
        for (std::size_t line = kLines; --line > 0;) {
            beyond += strips[line];
            if (beyond.seen < kFewestBeyond) continue;
            const float gain = gain_of(beyond, all.less(beyond));
            if (gain <= best.gain) continue;
            best = {direction, static_cast<float>(line) / per_spacing - kBehind, gain};
        }
    }

  private:
    PartSums sums_of(const DotOffset& dot) const {
        const float squared = dot.squared();
        const float on_plane = std::max(kOnPlane - squared / (2 * variance_), kOffPlane);
        if (squared > kTogether * variance_) return {1, on_plane};
        return {1,         on_plane,
                1,         dot.at.x,
                dot.at.y,  dot.off.x,
                dot.off.y, dot.at.x * dot.at.x + dot.at.y * dot.at.y,
                squared,   dot.at.x * dot.off.y - dot.at.y * dot.off.x};
    }

    /// What the dots of a part say for a plane of its own.
    float on_own_plane(const PartSums& part) const {
        return kOnPlane * part.dots - left_of(part) / (2 * variance_) +
               kOffPlane * (part.seen - part.dots);
    }

    /// By how much two parts explain the dots better than the plane as it is. What lies beyond may
    /// be anywhere; the plane may lie between the two.
    float gain_of(const PartSums& beyond, const PartSums& here) const {
        return weight_ * (std::max(on_own_plane(beyond), 0.0F) - beyond.on_plane +
                          std::max(on_own_plane(here) - here.on_plane, 0.0F));
    }

    std::array<DotOffset, kMostDots> dots_;
    std::size_t count_ = 0;
    float variance_;
    float weight_ = 1;
    float reach_ = 0;
};

FloatVec turned(FloatVec v, float c, float s) {
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace

Slip find_slip(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit,
               FloatVec reference_px) {
    const Search search(dots, plane, fit, reference_px);
    Slip best;
    constexpr float kCos = 0.98078528F;  // of a 32nd of a turn
    constexpr float kSin = 0.19509032F;
    FloatVec direction{1, 0};
    for (int i = 0; i < kDirections; ++i) {
        search.try_direction(direction, best);
        direction = turned(direction, kCos, kSin);
    }
    float s = kSin;
    for (int halving = 0; halving < 3; ++halving) {
        s /= 2;
        const float c = std::sqrt(1 - s * s);
        const FloatVec around = best.direction;
        search.try_direction(turned(around, c, s), best);
        search.try_direction(turned(around, c, -s), best);
    }
    return best;
}

}  // namespace dotpose::core
