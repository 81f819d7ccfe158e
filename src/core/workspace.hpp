// Workspace: the memory of a locator. After a frame, the workspace contains the results of the
// stages. All capacities are fixed. The constructor of a DeviceMemory, SmallMemory or LargeMemory
// creates the workspace in this memory. A locator reuses the workspace for each frame.
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
#include "core/known_sheets.hpp"
#include "core/lattice/neighbours.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Memory and results of the stages that desktops and devices share.
struct Workspace {
    std::int16_t min_side_px = kMinFrameSide_px;
    std::int16_t max_width_px = 0;
    std::int16_t max_height_px = kMaxFrameSide_px;
    /// True if stages do not share memory, so that the results of every stage remain available.
    bool keeps_every_stage = false;
    KnownSheets known;
    // Stage `detect`.
    AdaptiveThreshold threshold;
    OpenBlobs open;
    std::span<DetectedDot> dots;  ///< size: maximum number of dots
    int dot_count = 0;
    /// Maximum distance of stored dots from the image centre, along each axis. Decreases when
    /// `dots` is full.
    int dots_kept_within_px = 0;
    // Stage `lattice`.
    std::span<std::uint16_t> seeds;  ///< indices of dots
    int seed_count = 0;
    std::span<BucketedSeed> buckets;  ///< size: number of seeds plus 1
    /// Indices of the four nearest neighbours of each seed.
    std::span<std::array<std::int16_t, 4>> neighbours;
    std::span<SeedEdge> edges;  ///< size: two per seed
    int edge_count = 0;
    std::span<std::int32_t> edge_values;  ///< size: two per edge
    Lattice lattice;
    PlaneFromImage grid_from_image;
    // Stage `decode`.
    Grid grid;
    /// Column scores in the first half, row scores in the second half.
    std::span<ScoredLine> line_scores;
    Decoding decoding;
    // Stage `pose`.
    PlaneFromImage pattern_from_image;  ///< pattern points are relative to `Decoding::place`
    Fix fix;

    std::span<const DetectedDot> found_dots() const {
        return dots.first(static_cast<std::size_t>(dot_count));
    }
    /// Sets the known sheets and the minimum side of an image. The minimum is smaller if there are
    /// known sheets.
    void set_known(const KnownSheets& sheets) {
        known = sheets;
        min_side_px =
            static_cast<std::int16_t>(sheets.any() ? kMinKnownFrameSide_px : kMinFrameSide_px);
    }
};

/// Constructs a workspace in memory that the caller provides.
template <typename Space, std::size_t Bytes>
Space* make_workspace(std::array<std::byte, Bytes>& bytes) {
    static_assert(sizeof(Space) <= Bytes, "Memory::kBytes is too small");
    static_assert(std::is_trivially_destructible_v<Space>, "the destructor is never called");
    return ::new (static_cast<void*>(bytes.data())) Space;
}

}  // namespace dotpose::core
