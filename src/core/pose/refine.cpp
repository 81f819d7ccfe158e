#include "core/pose/refine.hpp"

#include <algorithm>
#include <cfloat>

namespace dotpose::core {
namespace {

/// So many dots, evenly spread, tell the displacement and the scatter.
constexpr std::size_t kSample = 256;

/// A step so small, in squared deviations of the pose, needs no other after it: it would be smaller
/// by far.
constexpr float kSettled = 0.01F;

/// Terms that are kept only in the share that is more than chance.
struct Group {
    std::size_t first;
    std::size_t count;
    /// They must explain so many times more than chance would. The curvature of a lens must be
    /// beyond doubt.
    float needed;
};
constexpr std::array<Group, 3> kGroups{{{4, 2, 1}, {6, 2, 1}, {8, 1, 12}}};

/// Median over a sample of the dots.
template <typename Value>
std::int32_t sampled_median(const Observations& observations, Value value) {
    const int every = observations.count() / static_cast<int>(kSample) + 1;
    std::array<std::int32_t, kSample> values;
    std::size_t count = 0;
    int seen = 0;
    observations.visit([&](const Observation& o) {
        if (seen++ % every == 0) values[count++] = value(o);
    });
    return median(std::span(values).first(count));
}

int reach_px(const Observations& observations, Vec centre_q8) {
    int reach_q8 = 0;
    observations.visit([&](const Observation& o) {
        reach_q8 = std::max(reach_q8, larger_component(o.image_point_q8 - centre_q8));
    });
    return reach_q8 / 256 + 1;
}

/// One round of Gauss and Newton.
class Round {
  public:
    Round(const Observations& observations, const PlaneFromImage& pose, int reach_px)
        : observations_(observations), pose_(pose), plane_(pose, reach_px) {}

    /// Sums up all dots that are not too far off.
    void add_dots(PoseFit& fit) const {
        // As printed and seen: ink spreads and lenses blur differently each time.
        const std::int32_t displacement_q16 =
            sampled_median(observations_, [&](const Observation& o) {
                const Vec offset = plane_point_q16(pose_, o.image_point_q8) -
                                   Vec{o.pattern_step.x * 65536, o.pattern_step.y * 65536};
                return offset.x * dx(o.symbol) + offset.y * dy(o.symbol);
            });
        const auto squared_residual_q30 = [&](const Observation& o) {
            const Vec residual =
                plane_point_q16(pose_, o.image_point_q8) - nominal_place_q16(o, displacement_q16);
            return static_cast<std::int32_t>(
                std::min<std::int64_t>(squared(residual) >> 2, INT32_MAX));
        };
        // Squared distances of a plane Gaussian have their median at 1.39 sigma^2; 12 medians lie
        // 4 sigma out, where 1 dot in 3,000 is lost by chance.
        const std::int64_t limit_q30 =
            12 * std::int64_t{sampled_median(observations_, squared_residual_q30)} + 64;
        const float limit = static_cast<float>(limit_q30) / 1073741824.0F;
        fit.normal = {};
        observations_.visit([&](const Observation& o) {
            const Vec target = nominal_place_q16(o, displacement_q16) - pose_.at_centre_q16;
            const ScaledPlane::Sight sight = plane_.look(o.image_point_q8);
            const float rx = static_cast<float>(target.x) / 65536.0F - sight.x;
            const float ry = static_cast<float>(target.y) / 65536.0F - sight.y;
            if (rx * rx + ry * ry <= limit) fit.normal.add(sight.jacobian, rx, ry);
        });
    }

    /// The plane of least squares, with as much of the further terms as is more than chance
    /// (James and Stein 1961). `moved`: by how much it differs, in squared deviations.
    bool solve(PoseFit& fit, PlaneFromImage& pose, float& moved) const {
        Normal& normal = fit.normal;
        if (normal.points() < 3 || !normal.decompose()) return false;
        Parameters step = normal.whitened(normal.right());
        float left = normal.squared_residuals();
        for (const float part : step)
            left -= part * part;
        fit.dots = normal.points();
        const int freedom = std::max(2 * fit.dots - static_cast<int>(kPoseParameters), 1);
        fit.variance = std::max(left, 0.0F) / static_cast<float>(freedom);
        // Whitened, what each group explains is independent of those after it.
        Parameters all = normal.unwhitened(step);
        const Parameters now = plane_.distortions();
        for (std::size_t i = 4; i < kPoseParameters; ++i)
            all[i] += now[i];
        const Parameters whole = normal.times_transposed(all);
        fit.is_fitted.fill(true);
        for (const Group& group : kGroups) {
            float gain = 0;
            for (std::size_t i = group.first; i < group.first + group.count; ++i)
                gain += whole[i] * whole[i];
            const float by_chance = static_cast<float>(group.count) * fit.variance;
            const float share = gain > group.needed * by_chance ? 1 - by_chance / gain : 0;
            for (std::size_t i = group.first; i < group.first + group.count; ++i) {
                step[i] -= (1 - share) * whole[i];
                fit.is_fitted[i] = share > 0;
            }
        }
        pose = plane_.changed(normal.unwhitened(step));
        moved = 0;
        for (const float part : step)
            moved += part * part;
        moved /= std::max(fit.variance, FLT_MIN);
        return true;
    }

  private:
    const Observations& observations_;
    const PlaneFromImage& pose_;
    ScaledPlane plane_;
};

}  // namespace

bool refine_pose(const Observations& observations, PlaneFromImage& pose, PoseFit& fit) {
    constexpr int kMostRounds = 4;
    fit.reach_px = reach_px(observations, pose.centre_q8);
    float moved = 1;
    for (int i = 0; i < kMostRounds && moved > kSettled; ++i) {
        const Round round(observations, pose, fit.reach_px);
        round.add_dots(fit);
        PlaneFromImage better;
        if (!round.solve(fit, better, moved)) return false;
        pose = better;
    }
    return true;
}

}  // namespace dotpose::core
