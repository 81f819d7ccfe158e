/// Times many different frames individually, to show how much the time varies.
#pragma once

#include <array>
#include <string>

namespace dotpose::bench {

/// The ways to process the frames, in the order of the table.
enum class Way : std::uint8_t {
    twice,
    once,
    narrow,   ///< the first attempt with vectors of 16 bytes, as without AVX2
    tracked,  ///< with predictions that are off by up to a third of a spacing and 2 degrees
    device,
    floor,
    apriltag_1,
    apriltag_2,
};
inline constexpr std::size_t kWays = 8;

/// Statistics of the times of one way in µs, where each frame counts with its fastest pass.
struct FrameSpread {
    int frames = 0;
    int found = 0;
    double median_us = 0;
    double p99_us = 0;
    double longest_us = 0;

    double longest_over_median() const { return longest_us / median_us; }
    double p99_over_median() const { return p99_us / median_us; }
};

struct Varied {
    std::array<FrameSpread, kWays> spreads;
    const FrameSpread& of(Way way) const { return spreads[static_cast<std::size_t>(way)]; }
};

/// Times nominal frames of 188 x 120 px, and a tenth as many frames with a tag. Throws Error if a
/// fix is wrong.
Varied time_varied_frames(int frames, int passes);
std::string varied_table(const Varied& varied);

}  // namespace dotpose::bench
