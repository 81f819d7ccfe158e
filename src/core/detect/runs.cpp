#include "core/detect/runs.hpp"

#include <bit>
#include <cstring>

#include "core/detect/light.hpp"
#include "core/vectors.hpp"
#include "core/wide.hpp"

namespace dotpose::core {
namespace {

constexpr std::uint64_t kHighs = 0x8080808080808080;

/// Eight bytes from anywhere.
std::uint64_t eight_at(const std::uint8_t* bytes) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes, sizeof eight);
    return eight;
}

/// Bit k of byte j goes to bit j of byte k (Warren, Hacker's Delight, 7-3).
std::uint64_t transposed(std::uint64_t bits) {
    const auto swap = [&](int distance, std::uint64_t mask) {
        const std::uint64_t different = (bits ^ bits >> distance) & mask;
        bits ^= different ^ different << distance;
    };
    swap(7, 0x00AA00AA00AA00AA);
    swap(14, 0x0000CCCC0000CCCC);
    swap(28, 0x00000000F0F0F0F0);
    return bits;
}

/// A bit for each of 64 pixels, the first the lowest, set where it is dark.
std::uint64_t dark_bits(const std::uint8_t* pixels, const std::uint8_t* half_extents) {
    // Group k gives bit k of eight bytes.
    Sixteen bits{1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2};
    Sixteen dark{};
    for (std::size_t k = 0; k < 64; k += sizeof bits) {
        const Sixteen extents = sixteen_at(half_extents + k) << 1;
        dark |= (sixteen_at(pixels + k) < extents) & bits;
        bits <<= 2;
    }
    std::uint64_t halves[2];
    std::memcpy(halves, &dark, sizeof halves);
    return transposed(halves[0] | halves[1]);
}

/// The same of up to 64.
std::uint64_t dark_bits(const std::uint8_t* pixels, const std::uint8_t* half_extents,
                        std::size_t count) {
    if (count >= 64) return dark_bits(pixels, half_extents);
    std::uint64_t dark = 0;
    for (std::size_t k = 0; k < count; k += kGroup_px) {
        const std::uint64_t light =
            (eight_at(pixels + k) >> 1 | kHighs) - eight_at(half_extents + k);
        dark |= ((~light & kHighs) >> 7) * 0x0102040810204080 >> 56 << k;
    }
    return dark;
}

/// Whether some byte of `a` is less than that of `b`.
bool is_any_less(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t low_difference = (a | kHighs) - (b & ~kHighs);
    return (((~a & b) | (~(a ^ b) & ~low_difference)) & kHighs) != 0;
}

/// Sets the sums of a run.
void sum_up(const std::uint8_t* row, const Light& light, Run& run) {
    constexpr std::uint64_t kHalves = 0x00FF00FF00FF00FF;
    constexpr std::uint64_t kSum = 0x0001000100010001;     // of four halves, in the highest
    constexpr std::uint64_t kMoment = 0x0000000200040006;  // each times twice its index
    const std::size_t end = run.end;
    std::size_t u = run.begin;
    std::uint32_t mass = 0;
    std::uint32_t sum_x = 0;
    bool has_core = false;
    do {
        const std::size_t unused = end - u < 8 ? 8 - (end - u) : 0;
        const std::uint64_t in_run = ~std::uint64_t{0} >> 8 * unused;
        const std::uint64_t pixels = eight_at(row + u);
        const std::uint64_t extents = eight_at(light.half_extents.data() + u) << 1;
        const std::uint64_t depths = (extents & in_run) - (pixels & in_run);
        const std::uint64_t odd = depths >> 8 & kHalves;
        const std::uint64_t pairs = (depths & kHalves) + odd;
        const auto part = static_cast<std::uint32_t>(pairs * kSum >> 48);
        const auto moment = static_cast<std::uint32_t>((pairs * kMoment + odd * kSum) >> 48);
        mass += part;
        sum_x += part * static_cast<std::uint32_t>(u) + moment;
        has_core |= is_any_less(pixels | ~in_run, eight_at(light.cores.data() + u));
        u += 8;
    } while (u < end);
    run.mass = mass;
    run.sum_x = sum_x;
    run.has_core = has_core;
}

/// A run from each change of a row from light to dark and back: without a branch for each pixel.
int find_runs_by_word(int v, const Light& light, std::span<Run> runs) {
    const std::uint8_t* const row = kept_row(light, v);
    const auto row_end = static_cast<std::size_t>(whole_width(light));
    Run* run = runs.data();
    const Run* const end = run + runs.size();
    bool is_dark = false;
    for (std::size_t u = 0; u < row_end || is_dark; u += 64) {
        const std::size_t left = row_end > u ? row_end - u : 0;
        const std::uint64_t dark = dark_bits(row + u, light.half_extents.data() + u, left);
        std::uint64_t changes = dark ^ (dark << 1 | static_cast<std::uint64_t>(is_dark));
        for (; changes != 0; changes &= changes - 1) {
            if (run == end) return static_cast<int>(runs.size());
            const std::size_t column = u + static_cast<std::size_t>(std::countr_zero(changes));
            is_dark = !is_dark;
            if (is_dark) {
                run->begin = static_cast<std::uint16_t>(column);
            } else {
                run->end = static_cast<std::uint16_t>(column);
                sum_up(row, light, *run++);
            }
        }
    }
    return static_cast<int>(run - runs.data());
}

}  // namespace

int find_runs(int v, const Light& light, std::span<Run> runs) {
    if constexpr (kIsWide) {
        return find_runs_by_word(v, light, runs);
    } else {
        return find_runs_by_pixel(v, light, runs);
    }
}

}  // namespace dotpose::core
