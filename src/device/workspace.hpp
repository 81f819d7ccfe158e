// Device workspace: the memory of a DeviceLocator.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/workspace.hpp"
#include "device/in_whole_code.hpp"
#include "device/on_sheets.hpp"
#include "device/tracking.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Memory and results for a tracked frame, and for the stages that desktops and devices share.
struct DeviceWorkspace : Workspace {
    bool is_tracking = false;  ///< true if the current frame is tracked from a prediction
    /// True if the rows of the current frame are stored, and its dots are found after the last row
    /// (see device/small_frame.hpp).
    bool keeps_frame = false;
    Tracking tracking;
    const SheetFunctions* on_sheets = nullptr;  ///< null if no sheets are known
    /// Null if all frames are so small that they can be located only on known sheets.
    const WholeCodeFunctions* in_whole_code = nullptr;

    void set_known(const KnownSheets& sheets) {
        Workspace::set_known(sheets);
        on_sheets = sheets.any() ? &kSheetFunctions : nullptr;
    }
    void forget_known() {
        Workspace::set_known({});
        on_sheets = nullptr;
    }
};

/// Capacities of a device workspace: the maximum frame size, and the maximum number of dots and
/// other elements that the stages can store.
struct DeviceCapacity {
    int width_px = 0;
    /// Maximum height of a frame. Must be at most kMaxSideWithLowTiles_px if `width_px` exceeds
    /// kMaxSideWithLowTiles_px.
    int height_px = kMaxFrameSide_px;
    int dots = 0;
    int grid_side = 0;
    /// Maximum number of lines per axis that are compared with the whole code. 0 if only known
    /// sheets are read, and -1 if all lines of the grid are compared.
    int scored_lines = -1;
    /// Maximum number of dots used to find the axes of the grid.
    int seeds = 64;
    // Maximum numbers of runs and blobs in one row. These limits far exceed the number of dots in a
    // row, so any further runs and blobs are noise or graphics.
    int runs = 0;
    int blobs = 0;
    // Maximum number of runs in a whole frame. This limit bounds the processing time. The dots in a
    // frame of 188 x 120 px consist of about 500 runs. Noisy frames of this size were still located
    // with up to 1,900 runs.
    int max_runs = 0;
};

/// Capacities for each frame size. They are sufficient for spacings of about 11 px or more (6 px or
/// more in frames of 36 x 36 px). Each size is also listed in dotpose/memory.hpp.
template <int Width, int Height>
inline constexpr DeviceCapacity kDeviceCapacity{};
template <>
inline constexpr DeviceCapacity kDeviceCapacity<36, 36>{.width_px = 36,
                                                        .dots = 96,
                                                        .grid_side = 14,
                                                        .scored_lines = 0,
                                                        .seeds = 40,
                                                        .runs = 20,
                                                        .blobs = 16,
                                                        .max_runs = 400};
template <>
inline constexpr DeviceCapacity kDeviceCapacity<160, 120>{
    .width_px = 160, .dots = 216, .grid_side = 20, .runs = 56, .blobs = 48, .max_runs = 1700};
template <>
inline constexpr DeviceCapacity kDeviceCapacity<188, 120>{
    .width_px = 188, .dots = 256, .grid_side = 24, .runs = 64, .blobs = 56, .max_runs = 2000};
template <>
inline constexpr DeviceCapacity kDeviceCapacity<320, 240>{.width_px = 320,
                                                          .height_px = kMaxSideWithLowTiles_px,
                                                          .dots = 720,
                                                          .grid_side = 34,
                                                          .runs = 104,
                                                          .blobs = 96,
                                                          .max_runs = 6800};

/// Workspace of a DeviceLocator on a small microcontroller, for frames of one size. A workspace for
/// 188 x 120 px takes about 12 KB. The stages share memory, so after a frame, only the results of
/// the last stage are left. The stages access this memory through spans, so they are compiled only
/// once for all sizes.
template <DeviceCapacity kCapacity>
class DeviceWorkspaceOf : public DeviceWorkspace {
  public:
    static_assert(kCapacity.width_px >= kMinKnownFrameSide_px,
                  "kDeviceCapacity must have an entry for each size");
    static_assert(kCapacity.width_px <= kMaxSideWithLowTiles_px ||
                      kCapacity.height_px <= kMaxSideWithLowTiles_px,
                  "the workspace has memory for low tiles only");

    // The braces make the compiler clear all members with one call. Separate stores would add 800
    // bytes of code.
    DeviceWorkspaceOf() : DeviceWorkspace{} {
        max_width_px = kCapacity.width_px;
        if constexpr (kCapacity.height_px != kMaxFrameSide_px) max_height_px = kCapacity.height_px;
        dots = memory_of<FreshDots>(dot_memory_).dots;
        auto& pixels = memory_of<PixelStages>(memory_);
        threshold.rows = pixels.rows;
        threshold.tiles = pixels.tiles;
        threshold.half_low_levels = pixels.half_low_levels;
        threshold.high_levels = pixels.high_levels;
        open.blobs = pixels.blobs;
        open.runs = pixels.runs;
        auto& lattices = memory_of<LatticeStages>(memory_);
        seeds = lattices.seeds;
        buckets = lattices.buckets;
        neighbours = lattices.neighbours;
        edges = lattices.edges;
        edge_values = lattices.edge_values;
        auto& decoders = memory_of<DecodeStages>(memory_);
        grid.storage = decoders.cells;
        line_scores = decoders.line_scores;
        grid.side = kCapacity.grid_side;
        auto& tracked = memory_of<TrackedStages>(memory_);
        tracking.rows = tracked.rows;
        tracking.lines = tracked.lines;
        tracking.grid_rows = memory_of<TrackedDots>(dot_memory_).grid_rows;
        tracking.found = dots;
        open.max_runs = kCapacity.max_runs;
        if constexpr (kScoredLines > 0) in_whole_code = &kWholeCodeFunctions;
    }
    DeviceWorkspaceOf(const DeviceWorkspaceOf&) = delete;
    DeviceWorkspaceOf& operator=(const DeviceWorkspaceOf&) = delete;

  private:
    static constexpr int kTiles = kCapacity.width_px / kTileWidth_px + 1;
    static constexpr int kLevels = kTiles * kTileWidth_px + kReadAhead_px;
    static constexpr int kSeeds = kCapacity.seeds;
    static constexpr int kScoredLines =
        kCapacity.scored_lines < 0 ? kCapacity.grid_side : kCapacity.scored_lines;

    struct PixelStages {
        alignas(8)
            std::array<std::uint8_t, 2 * kLowTile_px * kTiles * kTileWidth_px + kReadAhead_px> rows;
        std::array<OpenBlob, kCapacity.blobs> blobs;
        std::array<Run, 2 * kCapacity.runs> runs;
        alignas(8) std::array<std::uint8_t, kLevels> half_low_levels;
        alignas(8) std::array<std::uint8_t, kLevels> high_levels;
        std::array<Tile, 4 * kTiles> tiles;
    };
    struct LatticeStages {
        std::array<SeedEdge, 2 * kSeeds> edges;
        std::array<std::int32_t, 4 * kSeeds> edge_values;
        std::array<BucketedSeed, kSeeds + 1> buckets;
        std::array<std::array<std::int16_t, 4>, kSeeds> neighbours;
        std::array<std::uint16_t, kSeeds> seeds;
    };
    struct DecodeStages {
        std::array<GridCell, kCapacity.grid_side * kCapacity.grid_side> cells;
        std::array<ScoredLine, 2 * kScoredLines> line_scores;
    };
    struct TrackedStages {
        std::array<std::uint8_t, 36 * kCapacity.width_px> rows;
        std::array<ComparedLine, 2 * kMaxComparedLines> lines;
    };
    struct FreshDots {
        std::array<DetectedDot, kCapacity.dots> dots;
    };
    struct TrackedDots {
        std::array<TrackedRow, kMaxComparedLines> grid_rows;
    };

    template <typename Stages, std::size_t Size>
    static Stages& memory_of(std::array<std::byte, Size>& memory) {
        static_assert(sizeof(Stages) <= Size);
        return *static_cast<Stages*>(static_cast<void*>(memory.data()));
    }

    alignas(
        8) std::array<std::byte, std::max(sizeof(FreshDots), sizeof(TrackedDots))> dot_memory_{};
    alignas(
        8) std::array<std::byte, std::max({sizeof(PixelStages), sizeof(LatticeStages),
                                           sizeof(DecodeStages), sizeof(TrackedStages)})> memory_{};
};

template <int Width, int Height>
using DeviceWorkspaceFor = DeviceWorkspaceOf<kDeviceCapacity<Width, Height>>;
static_assert(sizeof(void*) > 4 || sizeof(DeviceWorkspaceFor<188, 120>) < 12 * 1024 + 512);

}  // namespace dotpose::core
