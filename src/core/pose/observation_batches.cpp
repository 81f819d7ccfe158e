#include "core/pose/observation_batches.hpp"

namespace dotpose::core {

void ObservationBatch::fill_up() {
    constexpr FixedVec kFar{1 << 14, 1 << 14};
    const std::size_t counted = count;
    while (count % 4 != 0)
        add({}, kFar, Symbol::up, 0);
    count = counted;
}

ObservationBatches::ObservationBatches(const Observations& observations, FixedVec centre_q8)
    : observations_(observations), centre_q8_(centre_q8) {
    const int every = observations.count() / static_cast<int>(ObservationBatch::kMax) + 1;
    sample_is_all_ = every == 1;
    int reach_q8 = 0;
    int wait = 0;
    observations.visit([&](const Observation& o) {
        reach_q8 = std::max<std::int32_t>(reach_q8, larger_component(o.image_point_q8 - centre_q8));
        if (wait == 0) add(o, sample_);
        wait = wait == 0 ? every - 1 : wait - 1;
    });
    sample_.fill_up();
    reach_px_ = reach_q8 / 256 + 1;
}

}  // namespace dotpose::core
