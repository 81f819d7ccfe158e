#include "core/pose/refine.hpp"

#include <algorithm>

namespace dotpose::core {
namespace {

/// So many dots, evenly spread, tell the displacement and the scatter.
constexpr std::size_t kSample = 256;
constexpr float kPower30 = 1073741824.0F;

/// A step so small, in squared deviations of the pose, needs no other after it: it would be smaller
/// by far.
constexpr float kSettled = 0.01F;

/// What cameras and prints are like, with deviations of a tilt: the change of scale from the middle
/// to the outermost dot, of which 2 degrees make about 0.01; of a shear, relative to the scale; of
/// a bend, the outermost dot's displacement relative to its distance. A bend must be beyond doubt.
constexpr std::array<Terms, 3> kTerms{{
    {kTilt, 2, {{{0.1F, 0}, {0.8F, 0.01F}, {0.1F, 0.1F}}}},
    {kShear, 2, {{{0.5F, 0}, {0.4F, 0.002F}, {0.1F, 0.03F}}}},
    {kBend, 1, {{{0.99F, 0}, {0.005F, 0.01F}, {0.005F, 0.1F}}}},
}};

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

/// How the scatter of dots depends on the light: printers scatter alike everywhere, noise counts
/// the more the less light there is. A line fitted to squared residuals.
class Scatter {
  public:
    void add(float noise, float squared_residual) {
        count_ += 1;
        noise_ += noise;
        squares_ += squared_residual;
        noise_noise_ += noise * noise;
        noise_squares_ += noise * squared_residual;
    }
    void fit() {
        const float mean_noise = noise_ / count_;
        const float mean_square = squares_ / count_;
        const float spread = noise_noise_ / count_ - mean_noise * mean_noise;
        constexpr float kLeastSpread = 1e-4F;
        if (spread <= kLeastSpread * mean_noise * mean_noise || mean_square <= 0) return;
        constexpr float kMostByNoise = 0.9F;
        const float slope = (noise_squares_ / count_ - mean_noise * mean_square) / spread;
        by_noise_ = std::clamp(slope / mean_square, 0.0F, kMostByNoise / mean_noise);
        always_ = 1 - by_noise_ * mean_noise;
    }
    /// That the typical dot has, over that of a dot.
    float weight(float noise) const { return 1 / (always_ + by_noise_ * noise); }

  private:
    float count_ = 0;
    float noise_ = 0;
    float squares_ = 0;
    float noise_noise_ = 0;
    float noise_squares_ = 0;
    float always_ = 1;
    float by_noise_ = 0;
};

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
        const float limit = static_cast<float>(limit_q30) / kPower30;
        Scatter scatter;
        if (observations_.know_noise()) {
            observations_.visit([&](const Observation& o) {
                const float square = static_cast<float>(squared_residual_q30(o)) / kPower30;
                scatter.add(observations_.noise(o), std::min(square, limit));
            });
            scatter.fit();
        }
        fit.normal = {};
        observations_.visit([&](const Observation& o) {
            const Vec target = nominal_place_q16(o, displacement_q16) - pose_.at_centre_q16;
            const ScaledPlane::Sight sight = plane_.look(o.image_point_q8);
            const float rx = static_cast<float>(target.x) / 65536.0F - sight.x;
            const float ry = static_cast<float>(target.y) / 65536.0F - sight.y;
            const float weight =
                observations_.know_noise() ? scatter.weight(observations_.noise(o)) : 1.0F;
            if (weight * (rx * rx + ry * ry) <= limit)
                fit.normal.add(sight.jacobian, rx, ry, weight);
        });
    }

    /// The plane of least squares, with as much of the further terms as is to be believed. `moved`:
    /// by how much it differs, in squared deviations.
    bool solve(PoseFit& fit, PlaneFromImage& pose, float& moved) const {
        Normal& normal = fit.normal;
        if (normal.points() < 3 || !normal.decompose()) return false;
        Parameters step = normal.whitened(normal.right());
        float left = normal.squared_residuals();
        for (const float part : step)
            left -= part * part;
        fit.dots = normal.points();
        const int freedom = std::max(2 * fit.dots - static_cast<int>(kPoseParameters), 1);
        constexpr float kExact = 1e-12F;
        fit.variance = std::max(left / static_cast<float>(freedom), kExact);
        // Whitened, what each of the further terms explains is independent of those after it.
        Parameters all = normal.unwhitened(step);
        const Parameters now = plane_.distortions();
        for (std::size_t i = kTilt; i < kPoseParameters; ++i)
            all[i] += now[i];
        const Parameters whole = normal.times_transposed(all);
        believe(whole, fit, step);
        pose = plane_.changed(normal.unwhitened(step));
        moved = 0;
        for (const float part : step)
            moved += part * part;
        moved /= fit.variance;
        return true;
    }

  private:
    /// Takes back from a step what is not to be believed of the further terms. `whole`: these as
    /// fitted, whitened.
    void believe(const Parameters& whole, PoseFit& fit, Parameters& step) const {
        fit.covariance = {};
        for (std::size_t i = 0; i < kTilt; ++i)
            fit.covariance[i][i] = fit.variance;
        for (const Terms& terms : kTerms) {
            const float unit = terms.first == kShear ? plane_.scale() : 1;
            const Belief belief = belief_in(terms, fit.normal, whole, fit.variance, unit);
            for (std::size_t i = 0; i < terms.count; ++i) {
                step[terms.first + i] += belief.mean[i] - whole[terms.first + i];
                for (std::size_t j = 0; j < terms.count; ++j)
                    fit.covariance[terms.first + i][terms.first + j] = belief.covariance[i][j];
            }
        }
    }

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
