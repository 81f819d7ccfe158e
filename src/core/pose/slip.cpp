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
        return {seen - o.seen,   on_plane - o.on_plane, dots - o.dots,
                x - o.x,         y - o.y,               off_x - o.off_x,
                off_y - o.off_y, squares - o.squares,   off_squares - o.off_squares,
                turned - o.turned};
    }
};

/// How a part lies if it moved as a whole.
struct Move {
    FloatVec shift;  ///< at the reference point
    float turn = 0;
    float left = 0;  ///< squared distances that it does not explain
};

Move move_of(const PartSums& part) {
    if (part.dots < 3) return {{}, 0, part.off_squares};
    const float by = 1 / part.dots;
    const FloatVec middle{part.x * by, part.y * by};
    const FloatVec off{part.off_x * by, part.off_y * by};
    const float spread =
        part.squares - part.dots * (middle.x * middle.x + middle.y * middle.y);
    const float turned = part.turned - part.dots * (middle.x * off.y - middle.y * off.x);
    const float turn = spread > 1e-3F ? turned / spread : 0;
    return {{off.x + turn * middle.y, off.y - turn * middle.x},
            turn,
            part.off_squares - part.dots * (off.x * off.x + off.y * off.y) - turn * turned};
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
            const Slip slip = slip_of(beyond, all.less(beyond));
            if (slip.gain <= best.gain) continue;
            best = slip;
            best.direction = direction;
            best.distance = static_cast<float>(line) / per_spacing - kBehind;
        }
    }

  private:
    PartSums sums_of(const DotOffset& dot) const {
        const float squared = dot.squared();
        const float on_plane = std::max(kOnPlane - squared / (2 * variance_), kOffPlane);
        if (squared > kTogether * variance_) return {1, on_plane};
        return {1,
                on_plane,
                1,
                dot.at.x,
                dot.at.y,
                dot.off.x,
                dot.off.y,
                dot.at.x * dot.at.x + dot.at.y * dot.at.y,
                squared,
                dot.at.x * dot.off.y - dot.at.y * dot.off.x};
    }

    float explained(const PartSums& part, const Move& move) const {
        return kOnPlane * part.dots - move.left / (2 * variance_) +
               kOffPlane * (part.seen - part.dots);
    }

    Slip slip_of(const PartSums& beyond, const PartSums& here) const {
        Slip slip;
        const Move there = move_of(beyond);
        const Move moved = move_of(here);
        const float by_move = explained(beyond, there);
        slip.knows_shift = by_move > 0;
        // The plane as it is may lie between the two parts.
        const float of_here = std::max(explained(here, moved) - here.on_plane, 0.0F);
        slip.gain = weight_ * (std::max(by_move, 0.0F) - beyond.on_plane + of_here);
        slip.shift = {there.shift.x - moved.shift.x, there.shift.y - moved.shift.y};
        slip.turn = there.turn - moved.turn;
        return slip;
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
