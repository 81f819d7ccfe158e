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
        pose = fitted.plane;
        quality.terms = fitted.terms;
    }
    return true;
}

}  // namespace dotpose::core
