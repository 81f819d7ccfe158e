// Workspace: the memory of a locator and, after a frame, the output of every stage. Capacities are
// fixed. The workspace is in the DeviceMemory, SmallMemory or LargeMemory of the caller and is
// reused for each frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

#include "core/decode/grid.hpp"
#include "core/detect/blobs.hpp"
#include "core/kernels/scores.hpp"
#include "core/lattice/neighbours.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Memory and results of the stages that desktops and devices share, as spans.
struct Workspace {
    std::int16_t max_width_px = 0;
    std::int16_t max_height_px = kMaxFrameSide_px;
    bool keeps_every_stage = false;  ///< true if each stage has its own memory, so that the output
                                     ///< of every stage remains
    // detect
    AdaptiveThreshold threshold;
    OpenBlobs open;
    std::span<DetectedDot> dots;  ///< size is the capacity
    int dot_count = 0;
    int dots_kept_within_px =
        0;  ///< distance from the image centre, per axis; decreases when `dots` is full
    // lattice
    std::span<std::uint16_t> seeds;  ///< indices of dots
    int seed_count = 0;
    std::span<BucketedSeed> buckets;                    ///< one more than there are seeds
    std::span<std::array<std::int16_t, 4>> neighbours;  ///< the four nearest of each seed
    std::span<SeedEdge> edges;                          ///< two for each seed
    int edge_count = 0;
    std::span<std::int32_t> edge_values;  ///< two for each edge
    Lattice lattice;
    PlaneFromImage grid_from_image;
    // decode
    Grid grid;
    std::span<ScoredLine> line_scores;  ///< the columns, then in the second half the rows
    Decoding decoding;
    // pose
    PlaneFromImage pattern_from_image;  ///< in spacings from `Decoding::place`
    Fix fix;

    std::span<const DetectedDot> found_dots() const {
        return dots.first(static_cast<std::size_t>(dot_count));
    }
};

/// Makes the workspace in the bytes of a Memory.
template <typename Space, std::size_t Bytes>
Space* make_workspace(std::array<std::byte, Bytes>& bytes) {
    static_assert(sizeof(Space) <= Bytes, "Memory::kBytes is too small");
    static_assert(std::is_trivially_destructible_v<Space>, "nothing destroys it");
    return ::new (static_cast<void*>(bytes.data())) Space;
}

}  // namespace dotpose::core
