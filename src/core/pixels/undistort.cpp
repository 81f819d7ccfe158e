#include "core/pixels/undistort.hpp"

#include "core/fixed.hpp"

namespace dotpose::core {

void undistort(const Lens& lens, Vec image_centre_q8, std::span<Dot> dots) {
    if (lens.k_q40 == 0) return;
    constexpr std::int64_t kOne_q30 = std::int64_t{1} << 30;
    for (Dot& dot : dots) {
        const Vec r_d = dot.centre_q8 - image_centre_q8;  // eq. 1
        const std::int64_t squared_q8 = squared(r_d) >> 8;
        const std::int64_t stretch_q30 =
            std::max(kOne_q30 + ((lens.k_q40 * squared_q8) >> 18), kOne_q30 / 4);
        const auto shrink = [&](std::int32_t r) {
            return static_cast<std::int32_t>(divide_rounded(r * kOne_q30, stretch_q30));
        };
        dot.centre_q8 = image_centre_q8 + Vec{shrink(r_d.x), shrink(r_d.y)};  // eq. 2
    }
}

}  // namespace dotpose::core
