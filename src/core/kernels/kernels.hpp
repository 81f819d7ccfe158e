// Kernels: the loops over pixels, dots and cells that take the time of the desktop's attempts. Each
// exists in several forms, one for each kind of processor, with the same results to the bit;
// `select.hpp` chooses. The desktop's attempts are in single precision; lengths in the image are
// px.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "code/tables.hpp"
#include "core/math/float_plane.hpp"
#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// A plane wave, in turns: cos(2 pi (kx x + ky y) - phase).
struct Waves {
    float kx = 0;  ///< turns per px of the first; the second stands at right angles to it
    float ky = 0;
    float power = 0;  ///< of both together, at most 2 for a grid without displacements
    std::array<float, 2> phase_cos{};
    std::array<float, 2> phase_sin{};
};

/// How dots are assigned to cells in one pass over them.
struct CellPass {
    float reach_px = 0;      ///< dots farther from the centre, along either axis, are left out
    float most_off = 0;      ///< so far from where they are looked for, spacings
    float displacement = 0;  ///< of the four places of a cell; 0: the cell's middle counts
    bool with_perspective = false;
};

/// Sums over the dots of one pass, for the least squares of a plane with perspective:
/// i (1 + g x + h y) = a x + b y + c, and likewise j with d, e, f. Without perspective `i` and `j`
/// have the first three only, and `square` none.
struct CellSums {
    float seen = 0;                 ///< dots within reach
    float used = 0;                 ///< of those, near enough to a place
    float squares = 0;              ///< of the distances from there
    std::array<float, 6> one{};     ///< 1, x, y, xx, xy, yy
    std::array<float, 6> i{};       ///< the same times i
    std::array<float, 6> j{};       ///< the same times j
    std::array<float, 6> square{};  ///< the same times i^2 + j^2
};

/// Columns and rows of cells that an image may show, turned by any angle.
inline constexpr int kMostLinesInView = 1024;

/// What cells are asked for: those of which the dot is in view.
struct CellsInView {
    FloatPlane plane;  ///< of the pattern, upright; (x, y) are counted from `centre`
    FloatLens lens;
    float centre_x = 0;  ///< px of the image
    float centre_y = 0;
    float width_px = 0;
    float height_px = 0;
    float margin_px = 0;         ///< a dot nearer to the border is none
    float reach_px = 0;          ///< nor is one so far from the centre, along either axis
    float displacement = 0;      ///< spacings
    bool window_on_dot = false;  ///< instead of the intersection
    int step = 1;                ///< of each row of cells, every so many-th
    /// Index in the main sequence of row 0 of each column, and of column 0 of each row.
    const std::uint8_t* column_rolls = nullptr;
    const std::uint8_t* row_rolls = nullptr;
    int first_column = 0;  ///< cells of the pattern, the first of the rolls
    int first_row = 0;
    int columns = 0;
    int rows = 0;
};

/// How windows are looked at.
struct WindowOptions {
    float spacing_px = 11;  ///< at the image centre
    float reach = 0.36F;  ///< of a window from its middle, in spacings; at most kMostHalfWindow_px
    int cut_q8 = 128;     ///< what is darker than the paper by this share, in 1/256, counts
    float typical_mass = 0;  ///< of a dot over the paper's level; 0: that of most windows
};
inline constexpr int kMostHalfWindow_px = 24;
inline constexpr float kMostBellReach_px = 24;
inline constexpr float kQuickBellReach_px = 4;  ///< a tenth of the instructions of wider ones

/// Sums for the nine-parameter fit; see Normal.
struct FitSums {
    float points = 0;
    float squared_residuals = 0;
    float projected =
        0;  ///< of the offsets from the intersections on the displacements' directions
    std::array<std::array<float, 9>, 9> matrix{};  ///< the lower triangle
    std::array<float, 9> right{};
};

/// Dots that lie where a plane has them, and what they are off. Four dots listed one after the
/// other are a run of neighbours.
struct FittingDots {
    int points = 0;
    int outliers = 0;           ///< dots that lie too far off
    float squares = 0;          ///< of what each is off
    float squares_of_runs = 0;  ///< of what each run is off together, by its dots
    int runs = 0;
};

/// What dots of square blocks of the image are off together.
struct BlockSums {
    static constexpr std::size_t kMostAlong = 9;
    struct Block {
        float dots = 0;  ///< that count
        float off_x = 0;
        float off_y = 0;
    };
    std::array<Block, kMostAlong * kMostAlong> all;
    float dots = 0;      ///< that count
    float outliers = 0;  ///< dots that do not
    float squares = 0;   ///< of what each is off
};

/// What dots say of the bits.
struct BitsRead {
    int seen = 0;  ///< dots of a dot's darkness
    int read = 0;  ///< of those, dots near one of the four places
    int wrong_x = 0;
    int wrong_y = 0;
    int right = 0;        ///< dots of which neither bit is wrong
    float projected = 0;  ///< of the right ones, their distances from the intersections
    float squares = 0;    ///< of the right ones, from their places
};

/// What an alternative that does not share a line loses there at least, in bits.
struct LineLoss {
    std::uint8_t line = 0;
    std::uint8_t loss = 0;
};

/// Places of a position's four sequences, each with a line that it shares with the reading.
struct SimilarPlaceList {
    static constexpr int kMost = 256;
    struct Entry {
        std::uint8_t sequence;
        std::uint8_t place;
        std::uint8_t line;
    };
    int count = 0;
    std::array<Entry, kMost> places;
};

/// A bit for each place of a sequence, from the lowest bit on.
using PlaceBits = std::array<std::uint32_t, 8>;

/// What an alternative loses at least where its digit differs from the reading's in a step from one
/// line to the next: one of the two lines. In parts, of which `kEnough` are enough.
struct StepLosses {
    static constexpr int kEnough = 8;
    int count = 0;
    std::array<std::uint8_t, 64> parts;  ///< at most kEnough
};

/// Words of bits, one for each of 64 lines of 64 cells.
struct BitLines {
    std::array<std::uint64_t, 64> bits{};
    std::array<std::uint64_t, 64> valid{};
};

struct Kernels {
    const char* name;
    /// Copies a part of the image, reduced by whole numbers, with a white margin.
    void (*fill_patch)(const ImageView& image, Patch& patch);
    /// Smooths it by 1-2-1 both ways, and finds the brightest and darkest pixel of each tile.
    void (*smooth_patch)(Patch& patch);
    /// Dots where the smoothed patch has minima darker than its thresholds, with parabolas through
    /// their neighbours; from the middle of the patch.
    void (*find_minima)(Patch& patch);
    /// The strongest of waves of about `per_px` turns per px, in 12 directions.
    Waves (*strongest_waves)(const float* x, const float* y, int count, float per_px);
    CellSums (*sum_cells)(const PatchDots& dots, const FloatPlane& plane, const CellPass& pass);
    /// Bits of the dots by the cell of the grid, counted from (-32, -32).
    void (*read_cells)(const PatchDots& dots, const FloatPlane& plane, float displacement,
                       BitLines& columns, BitLines& rows);
    /// Scores of 64 cells in a line against the main sequence from each of its offsets.
    void (*score_line)(std::uint64_t bits, std::uint64_t valid, ScoredLine& line);
    /// Cells in view, with where their windows lie, where the dots are printed, and where these are
    /// predicted, in `x` and `y`, as a camera with its lens sees them.
    void (*list_cells)(const CellsInView& view, MeasuredDots& dots);
    /// Mean of the surroundings of places in the image: where it is darkest, all dots are shifted
    /// to.
    bool (*find_shift)(const ImageView& image, const MeasuredDots& dots, int most_px, int step_px,
                       Vec& shift_px, int& cut_q8);
    /// Centres of what is dark in the dots' windows; none where that is much more or less than in
    /// a typical one, whose mass is returned.
    float (*measure_windows)(const ImageView& image, const CellsInView& view,
                             const WindowOptions& look, MeasuredDots& dots);
    /// The centres without the bias of a threshold: where the darkness around each is balanced,
    /// weighted by a bell of such a reach, at most kMostBellReach_px, or as far as the image has
    /// it.
    void (*refine_centres)(const ImageView& image, const CellsInView& view, float reach_px,
                           MeasuredDots& dots);
    /// Bits of cells whose dots are predicted to a fraction of their displacement: of the four
    /// places of each, the darkest has the dot. `depth_q8` is how much darker than paper a typical
    /// one is. Against the code's, and added to lines, as `read_bits` does; dots that are not right
    /// are no dots from there on.
    BitsRead (*read_levels)(const ImageView& image, const CellsInView& view, int depth_q8,
                            MeasuredDots& dots, BitLines* columns, BitLines* rows);
    /// Centres as `refine_centres` finds them, of dots that are predicted, by bells at most
    /// kQuickBellReach_px wide; none where that is too far off.
    void (*find_centres)(const ImageView& image, const CellsInView& view, float reach_px,
                         float most_off_px, MeasuredDots& dots);
    /// Bits of the dots as measured, against those that the code has there. Adds them to empty
    /// lines, where these are asked for, by the cell counted from (-32, -32); each cell may have
    /// one dot.
    BitsRead (*read_bits)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                          BitLines* columns, BitLines* rows);
    /// Sums over the dots that are at most `limit` (spacings^2) off.
    FitSums (*sum_fit)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                       float reach_px, float limit);
    FittingDots (*count_fitting)(const MeasuredDots& dots, const FloatPlane& plane,
                                 float displacement, float limit);
    /// The sums of at, scale and turn only; all else is 0.
    FitSums (*sum_similarity)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                              float reach_px, float limit);
    /// Sums over the dots of `side` x `side` blocks, which reach from the plane's centre as far
    /// along both axes, of those that are at most `limit` (spacings^2) off.
    void (*sum_blocks)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                       float limit, float reach_px, int side, BlockSums& sums);
    /// The other places of a sequence that may lose less than enough, as far as steps tell.
    PlaceBits (*find_similar_places)(const code::Secondary& sequence, std::uint32_t own,
                                     const StepLosses& steps);
    /// The other places of some of the sequences, a bit each, that may lose less than `enough` over
    /// these lines, the dearest first. False, if there are too many, or places that share none of
    /// the first lines may, too.
    bool (*list_similar_places)(const code::Basis& basis, const std::array<std::uint32_t, 4>& own,
                                unsigned sequences, std::span<const LineLoss> lines, int enough,
                                SimilarPlaceList& list);
};

}  // namespace dotpose::core
