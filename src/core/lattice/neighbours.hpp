// Neighbours: the four nearest dots of each dot near the image centre, and the symmetric edges
// between these dots. Paper section II-B.2. Differs: the paper connects all dots. Here, the first
// grid is fitted only to the seeds: the dots nearest the centre, at most kMaxSeeds. The grid is
// then extended outwards (device/grow.hpp, lattice/refine_grid.hpp). This bounds the time for any
// image.
#pragma once

#include <cstdint>

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Maximum number of seeds: the dots nearest the image centre, from which the first grid is
/// estimated.
inline constexpr int kMaxSeeds = 256;

/// Element of two independent arrays that share their memory. `at_q8` and `seed` are an element of
/// the array of seeds, which is sorted by bucket in row-major order. `begin` is an element of the
/// array of buckets.
struct BucketedSeed {
    FixedVec at_q8;           ///< place of the seed relative to the corner of the first bucket
    std::uint16_t seed = 0;   ///< index of the seed
    std::uint16_t begin = 0;  ///< index of the first seed of the bucket in the array of seeds
};

/// Chooses at most `seeds.size()` dots in a square around `centre_q8`. Uses the largest square that
/// does not contain more dots. The half side of the square is a multiple of the width of a
/// histogram bin. Writes the indices of the dots to `seeds` and returns their number.
int choose_seeds(std::span<const DetectedDot> dots, FixedVec centre_q8,
                 std::span<std::uint16_t> seeds);

/// Finds, for each seed, the four nearest other seeds within 128 px along each axis, nearest first.
/// Writes -1 for each missing neighbour. `memory` must have one more element than `seeds`.
void find_neighbours(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                     std::span<BucketedSeed> memory,
                     std::span<std::array<std::int16_t, 4>> neighbours);

/// Finds the pairs of seeds in which each seed is among the four nearest seeds of the other. Writes
/// each pair once, as an edge that points down or, if it is horizontal, right. Returns the number
/// of edges.
int connect_symmetric(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                      std::span<const std::array<std::int16_t, 4>> neighbours,
                      std::span<SeedEdge> edges);

/// Returns true if `to` is among the four nearest seeds of `from`.
inline bool counts(std::span<const std::array<std::int16_t, 4>> neighbours, int from, int to) {
    for (const std::int16_t n : neighbours[static_cast<std::size_t>(from)]) {
        if (n == to) return true;
    }
    return false;
}

/// Returns true if each seed is among the four nearest seeds of the other.
inline bool are_connected(std::span<const std::array<std::int16_t, 4>> neighbours, int a, int b) {
    return counts(neighbours, a, b) && counts(neighbours, b, a);
}

}  // namespace dotpose::core
