#include "core/pose/refine.hpp"

#include <array>

namespace dotpose::core {
namespace {

constexpr std::size_t kMedianSample = 256;

/// Takes every n-th value, so that the median of many is that of a few hundred.
class Sample {
  public:
    explicit Sample(int total) : every_(total / static_cast<int>(kMedianSample) + 1) {}
    void offer(std::int32_t value) {
        if (seen_++ % every_ == 0) values_[count_++] = value;
    }
    std::int32_t take_median() { return median(std::span(values_).first(count_)); }

  private:
    int every_;
    int seen_ = 0;
    std::size_t count_ = 0;
    std::array<std::int32_t, kMedianSample> values_;
};

/// The displacement as printed and seen: ink spreads and lenses blur differently each time.
std::int32_t measure_displacement(const Observations& observations, const PlaneFromImage& pose) {
    Sample displacements(observations.count());
    observations.visit([&](const Observation& o) {
        const Vec offset = plane_point_q16(pose, o.image_point_q8) -
                           Vec{o.pattern_step.x * 65536, o.pattern_step.y * 65536};
        displacements.offer(offset.x * dx(o.symbol) + offset.y * dy(o.symbol));
    });
    return displacements.take_median();
}

/// Sums over the dots of squared coordinates about their mean, and the mean.
struct Spread {
    Vec mean_q8;
    std::int64_t xx = 0;
    std::int64_t yy = 0;
};

template <typename Visit>
Spread spread_of(Visit visit) {
    std::int64_t n = 0;
    std::int64_t x = 0;
    std::int64_t y = 0;
    visit([&](Vec p, Vec) {
        ++n;
        x += p.x;
        y += p.y;
    });
    Spread spread;
    spread.mean_q8 = {static_cast<std::int32_t>(x / n), static_cast<std::int32_t>(y / n)};
    visit([&](Vec p, Vec) {
        const Vec d = p - spread.mean_q8;
        spread.xx += (std::int64_t{d.x} * d.x) >> 8;
        spread.yy += (std::int64_t{d.y} * d.y) >> 8;
    });
    return spread;
}

/// The plane with the slopes of a plain rotation and scale, or part of the way there; what lies at
/// the mean of the dots stays.
PlaneFromImage without_shear(const PlaneFromImage& plane, const Spread& spread, int sheared_q8) {
    const std::int64_t total = std::max<std::int64_t>((spread.xx + spread.yy) >> 16, 1);
    const std::int64_t xx = spread.xx >> 16;
    const std::int64_t yy = spread.yy >> 16;
    // Least squares: each axis counts as much as the dots spread along it.
    const Vec du = plane.du_q24;
    const Vec dv = plane.dv_q24;
    const Vec along{static_cast<std::int32_t>((xx * du.x + yy * dv.y) / total),
                    static_cast<std::int32_t>((xx * du.y - yy * dv.x) / total)};
    const auto blend = [&](std::int32_t straight, std::int32_t sheared) {
        return straight +
               static_cast<std::int32_t>((std::int64_t{sheared} - straight) * sheared_q8 / 256);
    };
    PlaneFromImage result = plane;
    result.du_q24 = {blend(along.x, du.x), blend(along.y, du.y)};
    result.dv_q24 = {blend(-along.y, dv.x), blend(along.x, dv.y)};
    result.at_centre_q16 = result.at_centre_q16 + plane_point_q16(plane, spread.mean_q8) -
                           plane_point_q16(result, spread.mean_q8);
    return result;
}

/// Cameras have square pixels and sheets equal scales, nearly: shear is kept only in the share that
/// is more than chance, as the further terms are in fit_plane. Angle and position gain.
template <typename Visit>
void shrink_shear(Visit visit, const FittedPlane& fitted, PlaneFromImage& pose,
                  FitQuality& quality) {
    const Spread spread = spread_of(visit);
    const PlaneFromImage straight = without_shear(fitted.plane, spread, 0);
    std::int64_t squared_residuals = 0;
    visit([&](Vec point_q8, Vec target) {
        squared_residuals += squared(plane_point_q16(straight, point_q8) - target);
    });
    const int freedom = std::max(2 * fitted.points - static_cast<int>(parameters(fitted.terms)), 1);
    const std::int64_t gain = squared_residuals - fitted.squared_residuals;
    const std::int64_t by_chance = 2 * fitted.squared_residuals / freedom;
    quality.sheared_q8 = gain <= by_chance ? 0 : static_cast<int>(256 - by_chance * 256 / gain);
    quality.spread_u_q8 =
        static_cast<int>(spread.xx / std::max<std::int64_t>((spread.xx + spread.yy) >> 8, 1));
    pose = without_shear(fitted.plane, spread, quality.sheared_q8);
}

}  // namespace

bool refine_pose(const Observations& observations, PlaneFromImage& pose, FitQuality& quality) {
    for (int round = 0; round < 2; ++round) {
        quality.displacement_q16 = measure_displacement(observations, pose);
        Sample residuals(observations.count());
        observations.visit([&](const Observation& o) {
            const Vec target = nominal_place_q16(o, quality.displacement_q16);
            const Vec residual = plane_point_q16(pose, o.image_point_q8) - target;
            residuals.offer(static_cast<std::int32_t>(
                std::min<std::int64_t>(squared(residual) >> 2, INT32_MAX)));
        });
        // Squared distances of a plane Gaussian have their median at 1.39 sigma^2; 12 medians lie
        // 4 sigma out, where 1 dot in 3,000 is lost by chance.
        quality.residual_limit = 12 * std::int64_t{residuals.take_median()} + 64;
        FittedPlane fitted;
        const auto visit_kept = [&](auto use) {
            observations.visit([&](const Observation& o) {
                const Vec target = nominal_place_q16(o, quality.displacement_q16);
                const Vec residual = plane_point_q16(pose, o.image_point_q8) - target;
                if (squared(residual) >> 2 <= quality.residual_limit) use(o.image_point_q8, target);
            });
        };
        if (!fit_plane(pose, Terms::lens, visit_kept, fitted)) return false;
        quality.terms = fitted.terms;
        shrink_shear(visit_kept, fitted, pose, quality);
    }
    return true;
}

}  // namespace dotpose::core
