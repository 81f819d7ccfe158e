// Observation batches: splits observations into batches, for fits that visit all dots in each
// iteration.
#pragma once

#include <array>
#include <cstddef>

#include "core/pose/observations.hpp"

namespace dotpose::core {

/// Dots as a structure of arrays, for vector instructions.
struct ObservationBatch {
    static constexpr std::size_t kMax = 256;
    template <typename Value>
    using Values = std::array<Value, kMax>;

    std::size_t count = 0;
    Values<std::int32_t> x_q8;  ///< image point relative to the plane's centre, in 2^-8 px
    Values<std::int32_t> y_q8;
    Values<std::int32_t> step_x_q16;  ///< intersection, in 2^-16 spacings
    Values<std::int32_t> step_y_q16;
    Values<std::int32_t> dx;  ///< displacement direction: -1, 0 or 1
    Values<std::int32_t> dy;
    Values<float> noise;  ///< `Observations::noise`, or 0 if unknown

    void add(FixedVec from_centre_q8, FixedVec pattern_step, Symbol symbol, float its_noise) {
        x_q8[count] = from_centre_q8.x;
        y_q8[count] = from_centre_q8.y;
        step_x_q16[count] = pattern_step.x * 65536;
        step_y_q16[count] = pattern_step.y * 65536;
        dx[count] = dotpose::dx(symbol);
        dy[count] = dotpose::dy(symbol);
        noise[count++] = its_noise;
    }
    /// Pads the batch to a multiple of four with dots that are too far away to be inliers. `count`
    /// excludes the padding.
    void fill_up();
};

/// Observations, with image points relative to the centre of a plane.
class ObservationBatches {
  public:
    ObservationBatches(const Observations& observations, FixedVec centre_q8);

    /// Returns an upper bound on |x| and |y| of all dots, relative to the centre, in px.
    int reach_px() const { return reach_px_; }
    /// Returns an evenly spaced sample of the dots, or all dots if they fit in one batch.
    const ObservationBatch& sample() const { return sample_; }

    /// Calls `use` for each padded batch of dots.
    template <typename Use>
    void visit(Use use) const {
        if (sample_is_all_) return use(sample_);
        ObservationBatch batch;
        observations_.visit([&](const Observation& o) {
            if (batch.count == ObservationBatch::kMax) {
                use(batch);
                batch.count = 0;
            }
            add(o, batch);
        });
        batch.fill_up();
        use(batch);
    }

  private:
    void add(const Observation& o, ObservationBatch& batch) const {
        batch.add(o.image_point_q8 - centre_q8_, o.pattern_step, o.symbol,
                  observations_.know_noise() ? observations_.noise(o) : 0);
    }

    const Observations& observations_;
    FixedVec centre_q8_;
    int reach_px_ = 1;
    bool sample_is_all_;
    ObservationBatch sample_;
};

}  // namespace dotpose::core
