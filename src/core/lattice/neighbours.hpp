// Neighbours: the nearest neighbours of each seed, and the symmetric edges between seeds (paper,
// section II-B.2). *Seeds* are the dots nearest the image centre, at most kMaxSeeds. The paper
// connects all dots. To limit the processing time, dotpose connects only the seeds, and fits the
// first grid to them. Later stages extend the grid outwards (device/grow.hpp,
// lattice/refine_grid.hpp).
#pragma once

#include <cstdint>

#include "dotpose/trace.hpp"

namespace dotpose::core {

inline constexpr int kMaxSeeds = 256;

/// One element from each of two independent arrays that share memory. `at_q8` and `seed` belong to
/// the array of seeds, which is sorted by bucket in row-major order. `begin` belongs to the array
/// of buckets.
struct BucketedSeed {
    FixedVec at_q8;           ///< position relative to the corner of the first bucket
    std::uint16_t seed = 0;   ///< index of the seed
    std::uint16_t begin = 0;  ///< index of the bucket's first seed
};

/// Chooses the dots in the largest square around `centre_q8` that contains at most `seeds.size()`
/// dots. The half-width of the square is a multiple of the bin width of a distance histogram. If a
/// square with a half-width of one bin already contains more dots, chooses the first `seeds.size()`
/// of them. Writes the dot indices to `seeds` and returns their number.
int choose_seeds(std::span<const DetectedDot> dots, FixedVec centre_q8,
                 std::span<std::uint16_t> seeds);

/// Finds the four nearest neighbours of each seed, and lists them nearest first. Ignores seeds that
/// are 128 px or more away along an axis. Writes -1 for each missing neighbour. `memory` must have
/// one more element than `seeds`.
void find_neighbours(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                     std::span<BucketedSeed> memory,
                     std::span<std::array<std::int16_t, 4>> neighbours);

/// Finds the symmetric edges between seeds. An edge is symmetric if each of its two seeds is among
/// the four nearest neighbours of the other. Writes each edge once, pointing down or, if
/// horizontal, right. Returns the number of edges.
int connect_symmetric(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                      std::span<const std::array<std::int16_t, 4>> neighbours,
                      std::span<SeedEdge> edges);

/// Returns true if `to` is among the four nearest neighbours of `from`.
inline bool counts(std::span<const std::array<std::int16_t, 4>> neighbours, int from, int to) {
    for (const std::int16_t n : neighbours[static_cast<std::size_t>(from)]) {
        if (n == to) return true;
    }
    return false;
}

/// Returns true if a and b are connected by a symmetric edge.
inline bool are_connected(std::span<const std::array<std::int16_t, 4>> neighbours, int a, int b) {
    return counts(neighbours, a, b) && counts(neighbours, b, a);
}

}  // namespace dotpose::core
