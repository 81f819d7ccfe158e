// Kernels: the loops over pixels, dots and cells that take most of the time of the desktop's
// attempts. Each exists in several forms, one for each kind of processor, with the same results to
// the bit; `select.hpp` chooses. They compute in single precision; lengths in the image are in px.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "code/tables.hpp"
#include "core/math/float_plane.hpp"
#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Two plane waves of the same length at right angles: cos(2 pi (kx x + ky y) - phase).
struct Waves {
    float kx = 0;  ///< turns per px of the first wave; the second is at right angles to it
    float ky = 0;
    float power = 0;  ///< of both waves; at most 2 for a grid without displacements
    /// The phases of both waves, as cosine and sine.
    std::array<float, 2> phase_cos{};
    std::array<float, 2> phase_sin{};
};

/// How dots are assigned to cells in one pass over them.
struct CellPass {
    float reach_px = 0;  ///< dots farther from the centre, along either axis, are left out
    float most_off = 0;  ///< largest distance of a dot from the nearest place of its cell, spacings
    float displacement = 0;  ///< of a cell's places from its middle, spacings; 0: middle
    bool with_perspective = false;
};

/// Sums over the dots of one pass, for the least squares of a plane with perspective: i (1 + g x +
/// h y) = a x + b y + c, and likewise j with d, e and f. Without perspective, only the first three
/// elements of `i` and `j` are set, and `square` is 0.
struct CellSums {
    float seen = 0;                 ///< dots within reach
    float used = 0;                 ///< dots of these that are near enough to a place
    float squares = 0;              ///< of the distances from these places, spacings^2
    std::array<float, 6> one{};     ///< sums of 1, x, y, xx, xy, yy
    std::array<float, 6> i{};       ///< the six sums with each term times i
    std::array<float, 6> j{};       ///< the six sums with each term times j
    std::array<float, 6> square{};  ///< the six sums with each term times i^2 + j^2
};

/// Most columns, and most rows, of cells that an image may show, turned by any angle.
inline constexpr int kMostLinesInView = 1024;

/// Where the windows of listed cells are put: nowhere, around intersections, or around dots.
enum class Windows : std::uint8_t { none, on_intersections, on_dots };

/// Which cells are asked for: those whose dot is in view.
struct CellsInView {
    FloatPlane plane;  ///< the upright pattern; image points are counted from `centre`
    FloatLens lens;
    float centre_x = 0;  ///< px from the image's first pixel
    float centre_y = 0;
    float width_px = 0;
    float height_px = 0;
    float margin_px = 0;     ///< a dot nearer to the border is not in view
    float reach_px = 0;      ///< nor is one farther from the centre, along either axis
    float displacement = 0;  ///< of dots from their intersections, spacings
    Windows windows = Windows::on_intersections;
    int step = 1;  ///< of each row of cells, every so many-th is listed
    /// Index in the main sequence of row `first_row` of each column, and of column `first_column`
    /// of each row.
    const std::uint8_t* column_rolls = nullptr;
    const std::uint8_t* row_rolls = nullptr;
    int first_column = 0;  ///< cell of the pattern at which the rolls begin
    int first_row = 0;
    int columns = 0;
    int rows = 0;
};

/// How windows are measured.
struct WindowOptions {
    float spacing_px = 11;  ///< at the image centre
    float reach = 0.36F;    ///< half the side of a window, in spacings; at most kMostHalfWindow_px
    int cut_q8 = 128;       ///< pixels count that are darker than the paper by this share, in 1/256
    float typical_mass = 0;  ///< of a dot, over the paper's level; 0 for that of most windows
};
inline constexpr int kMostHalfWindow_px = 24;
inline constexpr float kMostBellReach_px = 24;
inline constexpr float kQuickBellReach_px = 4;  ///< takes a tenth of a wider bell's time
/// Reach of the bells of predicted dots: small, against noise, but as far as the edge of a dot is
/// seen where dots are 8 to 13 px apart.
inline constexpr float kPredictedBellReach_px = 3.65F;

/// Sums over dots for the fit of nine parameters; see PlaneNormalFloat. Places (u, v) are where a
/// plane has the dots, from its `at`, in units of its scale; residuals (x, y) are in spacings.
struct FitSums {
    int points = 0;       ///< dots that count
    int outliers = 0;     ///< dots that lie too far off
    float farthest = 0;   ///< largest squared residual of a dot that counts
    float projected = 0;  ///< offset . direction of displacement
    float squares = 0;    ///< squared residuals
    /// 1, u, v, uu, uv, vv, uuu, uuv, uvv, vvv, quu, quv, qvv, qqu, qqv, qqq; q = uu + vv.
    std::array<float, 16> places{};
    std::array<float, 9> residuals{};  ///< x, y, xu, yv, yu, xv, au, av, aq; a = xu + yv
};

/// Sums over predicted dots: where they are, in px from the image's centre, and what they are off.
struct DotOffsets {
    int points = 0;
    float u = 0;  ///< sum of places
    float v = 0;
    float squares = 0;  ///< of the distances from the centre
    float squared = 0;  ///< squared offsets
    float off_u = 0;    ///< sum of offsets
    float off_v = 0;
    float along = 0;  ///< of offsets times places: along these, and across
    float across = 0;
    /// Sums of offsets times the direction of the dot's displacement along x, and along y.
    std::array<float, 2> of_x{};
    std::array<float, 2> of_y{};
};

/// Sums of residuals over the dots of square blocks of the image, in spacings.
struct BlockSums {
    static constexpr std::size_t kMostAlong = 9;
    struct Block {
        float dots = 0;  ///< those that count
        float off_x = 0;
        float off_y = 0;
    };
    std::array<Block, kMostAlong * kMostAlong> all;
    float dots = 0;      ///< those that count
    float outliers = 0;  ///< dots that lie too far off
    float squares = 0;   ///< sum of the dots' squared residuals, spacings^2
};

/// What was read of the dots' bits.
struct BitsRead {
    int seen = 0;  ///< dots with the darkness of a dot
    int read = 0;  ///< dots of these near one of the four places
    int wrong_x = 0;
    int wrong_y = 0;
    int right = 0;        ///< dots without a wrong bit
    float projected = 0;  ///< sum of the right dots' distances from their intersections
    float squares = 0;    ///< sum of the right dots' squared distances from their places
};

/// The bits that an alternative loses at least in a line that it does not share.
struct LineLoss {
    std::uint8_t line = 0;
    std::uint8_t loss = 0;
};

/// Places in a position's four sequences, each with a line that it shares with the reading.
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

/// A bit for each place of a sequence, the first in the lowest bit.
using PlaceBits = std::array<std::uint32_t, 8>;

/// What an alternative loses at least if its digit differs from the reading's in a step from one
/// line to the next, as it does not share one of the two. In parts, of which `kEnough` are enough.
struct StepLosses {
    static constexpr int kEnough = 8;
    int count = 0;
    std::array<std::uint8_t, 64> parts;  ///< of each step; at most kEnough
};

/// Alternatives by the set of sequences in which they differ: their number, and the probability
/// that all their digits in a step equal the reading's.
struct FarAlternatives {
    std::array<float, 8> equal{1, 1, 1, 1, 1, 1, 1, 1};
    std::array<float, 8> number{};
};

/// By n: the sum of the n smallest losses.
using LeastSums = std::array<std::int32_t, 9>;

/// Bits of 64 lines of 64 cells, a word for each line; `valid` says which bits were read.
struct BitLines {
    std::array<std::uint64_t, 64> bits{};
    std::array<std::uint64_t, 64> valid{};
};

/// The kernels in one form.
struct Kernels {
    const char* name;
    /// Copies a part of the image, reduced by a whole factor, with a white margin.
    void (*fill_patch)(const ImageView& image, Patch& patch);
    /// Smooths the patch by 1-2-1 both ways, and finds the brightest and darkest pixel of each
    /// tile.
    void (*smooth_patch)(Patch& patch);
    /// Lists dots, counted from the middle of the patch: minima of the smoothed patch that are
    /// darker than its thresholds, at the vertices of parabolas through their neighbours.
    void (*find_minima)(Patch& patch);
    /// Returns the strongest waves of about `per_px` turns per px, of 12 directions.
    Waves (*strongest_waves)(const float* x, const float* y, int count, float per_px);
    /// Returns the sums of one pass over the dots.
    CellSums (*sum_cells)(const PatchDots& dots, const FloatPlane& plane, const CellPass& pass);
    /// Sets the bits of the dots by their cells; cell (-32, -32) is the first.
    void (*read_cells)(const PatchDots& dots, const FloatPlane& plane, float displacement,
                       BitLines& columns, BitLines& rows);
    /// Scores 64 cells of a line against the main sequence at each roll.
    void (*score_line)(std::uint64_t bits, std::uint64_t valid, ScoredLine& line);
    /// Lists the cells in view, with the middle of their windows, the symbols of their dots and, in
    /// `x` and `y`, where a camera with this lens sees the dots.
    void (*list_cells)(const CellsInView& view, MeasuredDots& dots);
    /// Finds the shift at which the mean of the dots' surroundings is darkest, and by which share
    /// of the paper's level it is darker there, in 1/256. Returns false if too few dots are in
    /// view.
    bool (*find_shift)(const ImageView& image, const MeasuredDots& dots, int most_px, int step_px,
                       Vec& shift_px, int& cut_q8);
    /// Sets the centres of what is dark in the dots' windows; a dot is dropped if that is much more
    /// or less than in a typical window, whose mass is returned.
    float (*measure_windows)(const ImageView& image, const CellsInView& view,
                             const WindowOptions& options, MeasuredDots& dots);
    /// Sets centres without the bias of a threshold: where the darkness around each dot balances,
    /// weighted by a bell. Its reach is at most kMostBellReach_px, and less where the image ends.
    void (*refine_centres)(const ImageView& image, const CellsInView& view, float reach_px,
                           MeasuredDots& dots);
    /// Reads the bits of cells whose dots are predicted to a fraction of their displacement: of the
    /// four places of each cell the darkest has the dot. `depth_q8` is by how much a typical dot is
    /// darker than paper. Bits are compared and added to lines as by `read_bits`; dots with a wrong
    /// bit are dropped.
    BitsRead (*read_levels)(const ImageView& image, const CellsInView& view, int depth_q8,
                            MeasuredDots& dots, BitLines* columns, BitLines* rows);
    /// Sets the centres of predicted dots as `refine_centres` does, by bells of
    /// kPredictedBellReach_px; drops dots that are farther off than `most_off_px`. `weight_px` is
    /// the distance at which a bell's moment equals its weight; 0: dots in the middle of the list
    /// tell it. Returns the sums over the others.
    DotOffsets (*find_centres)(const ImageView& image, const CellsInView& view, float most_off_px,
                               float weight_px, MeasuredDots& dots);
    /// Reads the bits of measured dots and compares them with those that the code has there. Adds
    /// them to `columns` and `rows`, unless these are null; cell (-32, -32) is the first. Lines
    /// must be empty before, and no cell may have two dots.
    BitsRead (*read_bits)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                          BitLines* columns, BitLines* rows);
    /// Returns the sums over the dots that are at most `limit` (spacings^2) off. `scale` is the
    /// unit of places.
    FitSums (*sum_fit)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                       float scale, float limit);
    /// Sums up residuals of the dots that are at most `limit` (spacings^2) off, in `side` x `side`
    /// blocks, which reach `reach_px` from the plane's centre along both axes.
    void (*sum_blocks)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                       float limit, float reach_px, int side, BlockSums& sums);
    /// Returns the other places of a sequence that, as far as steps tell, may lose less than
    /// enough.
    PlaceBits (*find_similar_places)(const code::Secondary& sequence, std::uint32_t own,
                                     const StepLosses& steps);
    /// Returns the expected odds of alternatives that differ in several sequences. `best` has, for
    /// each line, the odds of the best other roll; at most `most_shared` lines in a row are shared.
    float (*sum_far_alternatives)(std::span<const float> best, int most_shared,
                                  const FarAlternatives& sets);
    /// Lists the other places, in the sequences whose bit is set, that may lose less than `enough`
    /// over these lines, which begin with the largest loss. Returns false if there are too many, or
    /// if places that share none of the first lines may lose less, too.
    bool (*list_similar_places)(const code::Basis& basis, const std::array<std::uint32_t, 4>& own,
                                unsigned sequences, std::span<const LineLoss> lines, int enough,
                                SimilarPlaceList& list);
    /// Sums up the smallest of 8 to 16 losses; negative ones count as 0.
    void (*sum_least_losses)(std::span<const std::int16_t> losses, LeastSums& sums);
};

}  // namespace dotpose::core
