#include "core/pose/slip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/vectors.hpp"
#include "core/pose/dot_offsets.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::slip;

constexpr float kOnPlane = tuned::kOnPlane;
constexpr float kOffPlane = tuned::kOffPlane;
constexpr std::size_t kMostDots = 1024;
constexpr std::size_t kLines = 48;  ///< tried in each direction
constexpr auto kLastLine = static_cast<std::int32_t>(kLines) - 1;
constexpr int kDirections = 8;
constexpr float kBehind = tuned::kBehind;

/// Sums over the dots of one part. Dots are together if a common displacement may explain them.
struct PartSums {
    Four counts;   ///< dots, log odds of the plane as it is; dots together, squared residuals
    Four places;   ///< of dots together: x, y, residuals along x and y
    Four squares;  ///< of dots together: squared distances from the reference point, turning

    PartSums& operator+=(const PartSums& o) {
        counts += o.counts;
        places += o.places;
        squares += o.squares;
        return *this;
    }
    PartSums less(const PartSums& o) const {
        return {counts - o.counts, places - o.places, squares - o.squares};
    }
    float seen() const { return counts[0]; }
    float on_plane() const { return counts[1]; }
    float dots() const { return counts[2]; }

    /// Returns the squared residuals that are left if the part was moved and turned as a whole.
    float left() const {
        if (dots() < 3) return counts[3];
        const float by = 1 / dots();
        const float x = places[0];
        const float y = places[1];
        const float off_x = places[2];
        const float off_y = places[3];
        const float spread = squares[0] - by * (x * x + y * y);
        const float turned = squares[1] - by * (x * off_y - y * off_x);
        const float by_turn = spread > 1e-3F ? turned * turned / spread : 0;
        return counts[3] - by * (off_x * off_x + off_y * off_y) - by_turn;
    }
};

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
            DotOffset dot = dot_offset(all, k, plane, fit.displacement);
            dot.at.x -= reference.x;
            dot.at.y -= reference.y;
            reach_ = std::max(reach_, dot.at.x * dot.at.x + dot.at.y * dot.at.y);
            places_[count_] = dot.at;
            sums_[count_++] = sums_of(dot);
        }
        reach_ = std::sqrt(reach_) + 0.1F;
    }

    /// Replaces `best` by the best line at right angles to a direction, if that has a larger gain.
    void try_direction(FloatVec direction, Slip& best) const {
        std::array<PartSums, kLines> strips{};
        const float per_spacing = static_cast<float>(kLines) / (reach_ + kBehind);
        PartSums all{};
        for (std::size_t k = 0; k < count_; ++k) {
            const float t = places_[k].x * direction.x + places_[k].y * direction.y + kBehind;
            const auto strip = static_cast<std::int32_t>(std::max(t, 0.0F) * per_spacing);
            strips[static_cast<std::size_t>(std::min(strip, kLastLine))] += sums_[k];
        }
        for (const PartSums& strip : strips)
            all += strip;
        PartSums beyond{};
        for (std::size_t line = kLines; --line > 0;) {
            beyond += strips[line];
            if (beyond.seen() < tuned::kFewestBeyond) continue;
            if (most_gain_of(beyond, all.less(beyond)) <= best.gain) continue;
            const float gain = gain_of(beyond, all.less(beyond));
            if (gain <= best.gain) continue;
            best = {direction, static_cast<float>(line) / per_spacing - kBehind, gain};
        }
    }

  private:
    PartSums sums_of(const DotOffset& dot) const {
        const float squared = dot.squared();
        const float on_plane = std::max(kOnPlane - squared / (2 * variance_), kOffPlane);
        if (squared > tuned::kTogether * variance_) return {Four{1, on_plane}, Four{}, Four{}};
        const auto& [x, y] = dot.at;
        return {Four{1, on_plane, 1, squared}, Four{x, y, dot.off.x, dot.off.y},
                Four{x * x + y * y, x * dot.off.y - y * dot.off.x}};
    }

    /// Returns the log odds of the part's dots for a plane of its own.
    float on_own_plane(const PartSums& part) const {
        return kOnPlane * part.dots() - part.left() / (2 * variance_) +
               kOffPlane * (part.seen() - part.dots());
    }

    /// Returns what `gain_of` is at most, for the least residuals that are conceivable.
    float most_gain_of(const PartSums& beyond, const PartSums& here) const {
        const auto most_of = [](const PartSums& part) {
            return kOnPlane * part.dots() + kOffPlane * (part.seen() - part.dots());
        };
        return weight_ * (std::max(most_of(beyond), 0.0F) - beyond.on_plane() +
                          std::max(most_of(here) - here.on_plane(), 0.0F));
    }

    /// Returns by how much two parts explain the dots better than the plane as it is, as a log
    /// likelihood ratio. The part beyond may be displaced in any way; the plane as it is may be a
    /// compromise between both.
    float gain_of(const PartSums& beyond, const PartSums& here) const {
        return weight_ * (std::max(on_own_plane(beyond), 0.0F) - beyond.on_plane() +
                          std::max(on_own_plane(here) - here.on_plane(), 0.0F));
    }

    std::array<FloatVec, kMostDots> places_;
    std::array<PartSums, kMostDots> sums_;
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
    constexpr float kSin = 0.70710678F;  // sine and cosine of an eighth of a turn
    FloatVec direction{1, 0};
    for (int i = 0; i < kDirections; ++i) {
        search.try_direction(direction, best);
        direction = turned(direction, kSin, kSin);
    }
    // A line turned a little may explain more than the best one, but not four times as much.
    if (best.gain < Slip::kPossible / 4) return best;
    float s = kSin;
    for (int halving = 0; halving < 5; ++halving) {
        s /= 2;
        const float c = std::sqrt(1 - s * s);
        const FloatVec around = best.direction;
        search.try_direction(turned(around, c, s), best);
        search.try_direction(turned(around, c, -s), best);
    }
    return best;
}

}  // namespace dotpose::core
