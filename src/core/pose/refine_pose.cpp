#include "core/pose/refine_pose.hpp"

#include <algorithm>

#include "core/math/fixed.hpp"
#include "core/pose/observation_batches.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::fit;

constexpr float kPower30 = 1073741824.0F;

/// Linear model of a dot's squared residual as a function of its pixel noise
/// (`Observations::noise`). The constant term is due to print errors, which do not depend on the
/// illumination. The linear term is due to pixel noise: in dim light, the contrast is lower, so the
/// same noise has a larger effect.
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
        constexpr float kMinSpread = 1e-4F;
        if (spread <= kMinSpread * mean_noise * mean_noise || mean_square <= 0) return;
        const float slope = (noise_squares_ / count_ - mean_noise * mean_square) / spread;
        by_noise_ = std::clamp(slope / mean_square, 0.0F, tuned::kMaxByNoise / mean_noise);
        always_ = 1 - by_noise_ * mean_noise;
    }
    /// Returns the weight of a dot with the given noise: the mean variance of all dots divided by
    /// the variance of this dot.
    Four weight(Four noise) const { return 1.0F / (always_ + by_noise_ * noise); }

  private:
    float count_ = 0;
    float noise_ = 0;
    float squares_ = 0;
    float noise_noise_ = 0;
    float noise_squares_ = 0;
    float always_ = 1;
    float by_noise_ = 0;
};

/// One Gauss-Newton iteration. Computes and solves the normal equations at the current pose.
class Round {
  public:
    Round(const ObservationBatches& batches, const PlaneFromImage& pose)
        : batches_(batches), pose_(pose), plane_(scaled_from_centre(pose, batches.reach_px())) {
        const ObservationBatch& sample = batches.sample();
        ObservationBatch::Values<std::int32_t> x_q16;  // offsets from the intersections
        ObservationBatch::Values<std::int32_t> y_q16;
        ObservationBatch::Values<std::int32_t> values;
        for (std::size_t i = 0; i < sample.count; ++i) {
            const FixedVec offset =
                point_q16(sample, i) - FixedVec{sample.step_x_q16[i], sample.step_y_q16[i]};
            x_q16[i] = offset.x;
            y_q16[i] = offset.y;
            values[i] = offset.x * sample.dx[i] + offset.y * sample.dy[i];
        }
        // Measures the displacement of the dots instead of assuming the nominal value, because ink
        // spread and blur change it.
        displacement_q16_ = median(std::span(values).first(sample.count));
        for (std::size_t i = 0; i < sample.count; ++i) {
            values[i] = squared_q30({x_q16[i] - sample.dx[i] * displacement_q16_,
                                     y_q16[i] - sample.dy[i] * displacement_q16_});
        }
        const std::int64_t typical_q30 = median(std::span(values).first(sample.count));
        limit_ = static_cast<float>(tuned::kOutlier_medians * typical_q30 + 64) / kPower30;
    }

    PlaneNormal normal(bool know_noise) const {
        const Scatter scatter = know_noise ? scatter_of_dots() : Scatter();
        PlaneSums sums;
        batches_.visit([&](const ObservationBatch& batch) {
            for (std::size_t i = 0; i < batch.count; i += 4)
                add_four(batch, i, scatter, sums);
        });
        return PlaneNormal(sums.all());
    }

    bool solve(PoseFit& fit, PlaneFromImage& pose, float& moved) const {
        fit.displacement = static_cast<float>(displacement_q16_) / 65536.0F;
        Parameters step;
        if (!core::solve(plane_.distortions(), plane_.scale(), fit, step, moved)) return false;
        pose = stepped(pose_, plane_, step);
        return true;
    }

  private:
    static std::int32_t squared_q30(FixedVec residual_q16) {
        return static_cast<std::int32_t>(
            std::min<std::int64_t>(squared(residual_q16) >> 2, INT32_MAX));
    }

    FixedVec point_q16(const ObservationBatch& batch, std::size_t i) const {
        return plane_point_q16(pose_, pose_.centre_q8 + FixedVec{batch.x_q8[i], batch.y_q8[i]});
    }

    Scatter scatter_of_dots() const {
        Scatter scatter;
        batches_.visit([&](const ObservationBatch& batch) {
            for (std::size_t i = 0; i < batch.count; ++i) {
                const FixedVec target{batch.step_x_q16[i] + batch.dx[i] * displacement_q16_,
                                      batch.step_y_q16[i] + batch.dy[i] * displacement_q16_};
                const std::int32_t square_q30 = squared_q30(point_q16(batch, i) - target);
                scatter.add(batch.noise[i],
                            std::min(static_cast<float>(square_q30) / kPower30, limit_));
            }
        });
        scatter.fit();
        return scatter;
    }

    void add_four(const ObservationBatch& batch, std::size_t i, const Scatter& scatter,
                  PlaneSums& sums) const {
        const auto px = [](const std::int32_t* at_q8) {
            return __builtin_convertvector(four_at(at_q8), Four) / 256.0F;
        };
        const FourVecs places = plane_.project(px(&batch.x_q8[i]), px(&batch.y_q8[i]));
        const auto target = [&](const auto& step_q16, const auto& direction, std::int32_t at_q16) {
            const FourInts target_q16 =
                four_at(&step_q16[i]) + four_at(&direction[i]) * displacement_q16_ - at_q16;
            return __builtin_convertvector(target_q16, Four) / 65536.0F;
        };
        const Four x =
            target(batch.step_x_q16, batch.dx, pose_.at_centre_q16.x) - places.x * plane_.scale();
        const Four y =
            target(batch.step_y_q16, batch.dy, pose_.at_centre_q16.y) - places.y * plane_.scale();
        const Four weight = scatter.weight(four_at(&batch.noise[i]));
        sums.add(places, {{x, y}, weight * (x * x + y * y) <= limit_ ? weight : Four{}});
    }

    const ObservationBatches& batches_;
    const PlaneFromImage& pose_;
    ScaledPlane plane_;
    std::int32_t displacement_q16_ = 0;
    float limit_ = 0;  ///< outlier limit for weighted squared residuals, in spacings^2
};

}  // namespace

bool refine_pose(const Observations& observations, PlaneFromImage& pose, PoseFit& fit) {
    const ObservationBatches batches(observations, pose.centre_q8);
    fit.reach_px = batches.reach_px();
    float moved = 1;
    for (int i = 0; i < tuned::kMaxRounds && moved > tuned::kSettled; ++i) {
        const Round round(batches, pose);
        fit.normal = round.normal(observations.know_noise());
        PlaneFromImage better;
        if (!round.solve(fit, better, moved)) return false;
        pose = better;
    }
    return true;
}

}  // namespace dotpose::core
