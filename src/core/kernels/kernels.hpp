// Kernels: the inner loops over pixels, dots and cells. On desktop processors, these loops take
// most of the processing time of a frame. There is one implementation per vector width, and
// `select.hpp` chooses the fastest one for the processor. All implementations return bit-identical
// results. Image lengths are in px.
//
// A cell is a grid intersection with its dot. The *dot positions* of a cell are the four points
// where its dot may be printed: above, left, right and below the intersection.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "code/tables.hpp"
#include "core/kernels/scores.hpp"
#include "core/math/float_plane.hpp"
#include "core/math/vectors.hpp"
#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// A pair of plane waves cos(2 pi (kx x + ky y) - phase). The cross product of the two wave vectors
/// is positive.
struct Waves {
    /// Wave vectors (kx, ky), in cycles per px.
    std::array<float, 2> kx{};
    std::array<float, 2> ky{};
    /// Total power: the sum of phase_cos^2 + phase_sin^2 over both waves. It is about 2 n^2 for n
    /// dots that are exactly on intersections.
    float power = 0;
    /// Sums over all dots of cos(p) and sin(p), where p = 2 pi (kx x + ky y). The phase of a wave
    /// is atan2(phase_sin, phase_cos).
    std::array<float, 2> phase_cos{};
    std::array<float, 2> phase_sin{};
};

/// Options for `sum_cells`, which assigns dots to cells.
struct CellPass {
    float reach_px = 0;  ///< maximum distance from the origin to a dot, along each axis
    /// Maximum distance between a dot and the nearest dot position of its cell, in spacings. The
    /// sums exclude dots beyond this limit.
    float max_off = 0;
    /// Distance from an intersection to each of its four dot positions, in spacings. If 0, the
    /// intersection is the only dot position.
    float displacement = 0;
    bool with_perspective = false;
};

/// Sums for a least-squares fit of a plane with perspective:
///
///     i (1 + g x + h y) = a x + b y + c
///     j (1 + g x + h y) = d x + e y + f
///
/// (x, y) is the image point of a used dot, and (i, j) is the nearest dot position of its cell, in
/// pattern coordinates. Without perspective, `i` and `j` contain only the first three sums, and
/// `square` is 0.
struct CellSums {
    float seen = 0;  ///< number of dots within `CellPass::reach_px`
    float used = 0;  ///< number of these dots within `CellPass::max_off` of a dot position
    /// Sum of squared distances from the used dots to the nearest dot positions, in spacings^2.
    float squares = 0;
    std::array<float, 6> one{};  ///< sums of 1, x, y, xx, xy and yy over the used dots
    std::array<float, 6> i{};    ///< sums of i, i x, i y, i xx, i xy and i yy
    std::array<float, 6> j{};    ///< sums of j, j x, j y, j xx, j xy and j yy
    /// Sums of s, s x, s y, s xx, s xy and s yy, with s = i^2 + j^2.
    std::array<float, 6> square{};
};

/// Maximum number of lines in view per axis, at any rotation of the grid.
inline constexpr int kMaxLinesInView = 1024;

/// Points on which `list_cells` centres the measurement windows.
enum class Windows : std::uint8_t { none, on_intersections, on_dots };

/// Options for `list_cells`, which lists the cells with a visible dot.
struct CellsInView {
    /// Map from image points, relative to (centre_x, centre_y), to the upright pattern.
    FloatPlane plane;
    FloatLens lens;
    float centre_x = 0;  ///< origin of the image points, relative to the first pixel of the image
    float centre_y = 0;
    float width_px = 0;
    float height_px = 0;
    float margin_px = 0;  ///< minimum distance from a dot to the image border; may be negative
    /// True if `margin_px` and `reach_px` apply to intersections instead of dots. The list of cells
    /// then does not depend on the code.
    bool limits_intersections = false;
    /// Maximum |x| and |y| of a dot. (x, y) is the dot's undistorted image point.
    float reach_px = 0;
    float displacement = 0;  ///< distance from an intersection to its dot, in spacings
    Windows windows = Windows::on_intersections;
    int step = 1;  ///< `list_cells` lists every `step`-th cell of a row
    /// Roll of each column: the main-sequence index of its cell in row `first_row`.
    const std::uint8_t* column_rolls = nullptr;
    /// Roll of each row: the main-sequence index of its cell in column `first_column`.
    const std::uint8_t* row_rolls = nullptr;
    int first_column = 0;  ///< column of the first element of `column_rolls`
    int first_row = 0;
    int columns = 0;
    int rows = 0;
};

/// Options for `measure_windows`.
struct WindowOptions {
    float spacing_px = 11;  ///< spacing at the centre of the view
    /// Half-width of a window, in spacings. After conversion to px, it is clamped to [2,
    /// kMaxHalfWindow_px].
    float reach = 0.36F;
    /// A pixel belongs to a dot if it is darker than the paper by more than `cut_q8` / 256 of the
    /// paper level.
    int cut_q8 = 128;
    /// Typical mass of a dot, relative to the paper level. The mass is the summed darkness of the
    /// dot's pixels. If 0, `measure_windows` estimates the typical mass from the windows.
    float typical_mass = 0;
    /// True if most windows may contain graphics or blank paper instead of a dot.
    bool is_partial_view = false;
};
/// Maximum half-width of a measurement window.
inline constexpr int kMaxHalfWindow_px = 24;
/// Maximum radius of a centroid window.
inline constexpr float kMaxCentroidRadius_px = 24;
/// Maximum radius of a small centroid window. Measuring a small window is ten times as fast as
/// measuring a larger one.
inline constexpr float kSmallCentroidRadius_px = 4;
/// Radius of the centroid window for predicted dots. It is small enough to limit noise, and large
/// enough to include the edge of a dot at spacings of 8 to 13 px.
inline constexpr float kPredictedCentroidRadius_px = 3.65F;

/// Sums over the inliers for a nine-parameter fit (see PlaneNormal). (u, v) is the pattern point of
/// a dot relative to the plane's `at`, in units of `scale` (see `sum_fit`). (x, y) is the residual
/// of the dot, in spacings.
struct FitSums {
    int points = 0;      ///< number of inliers
    int outliers = 0;    ///< number of measured dots that are not inliers
    float farthest = 0;  ///< largest squared residual of an inlier, in spacings^2
    /// Sum of the inliers' offsets from their intersections, in spacings. Each offset is projected
    /// onto the direction of the dot's coded displacement.
    float projected = 0;
    float squares = 0;  ///< sum of the squared residuals, in spacings^2
    /// Sums of 1, u, v, uu, uv, vv, uuu, uuv, uvv, vvv, quu, quv, qvv, qqu, qqv and qqq, with q =
    /// uu + vv.
    std::array<float, 16> places{};
    /// Sums of x, y, xu, yv, yu, xv, au, av and aq, with a = xu + yv.
    std::array<float, 9> residuals{};
};

/// Sums over predicted dots. The predicted point (u, v) of a dot is relative to the view centre, in
/// px. The offset is the measured centre minus the predicted point.
struct DotOffsets {
    int points = 0;
    float u = 0;  ///< sums of the coordinates of the predicted points
    float v = 0;
    float squares = 0;  ///< sum of u^2 + v^2
    float squared = 0;  ///< sum of squared offsets
    float off_u = 0;    ///< sums of the offsets
    float off_v = 0;
    /// Sum of the inner products of (u, v) and the offset. `across` is the corresponding sum of
    /// cross products.
    float along = 0;
    float across = 0;
    /// Sums of d_x times the offset, along u and along v, where d is the direction of the dot's
    /// coded displacement. `of_y` contains the corresponding sums for d_y.
    std::array<float, 2> of_x{};
    std::array<float, 2> of_y{};
};

/// Sums over the dots in each image block.
struct BlockSums {
    static constexpr std::size_t kMaxAlong = 9;
    struct Block {
        Four sums;  ///< the sums below, in one vector, to add a dot in a single operation
        float inliers() const { return sums[0]; }
        float dots() const { return sums[1]; }  ///< number of measured dots, including outliers
        /// Sums of the residuals of the inliers along x and y, in spacings.
        float off_x() const { return sums[2]; }
        float off_y() const { return sums[3]; }
    };
    std::array<Block, kMaxAlong * kMaxAlong> all{};
    float squares = 0;  ///< sum of the squared residuals of all inliers, in spacings^2
};

/// Result of comparing cell bits with the code.
struct BitsRead {
    int seen = 0;     ///< number of cells with a dark spot
    int read = 0;     ///< number of `seen` cells whose spot is clearly at a dot position
    int wrong_x = 0;  ///< number of `read` cells whose x bit disagrees with the code
    int wrong_y = 0;
    int right = 0;  ///< number of `read` cells without a wrong bit
    /// Sum of max(|x|, |y|) over the `right` dots, in spacings. (x, y) is the offset of a dot from
    /// its intersection.
    float projected = 0;
    /// Sum of the squared distances between the `right` dots and their expected positions, in
    /// spacings^2.
    float squares = 0;
};

/// A line, with a lower bound on the loss of any alternative that does not share it. The caller
/// chooses the unit of the loss. The *reading* is the position that was read, and an *alternative*
/// is any other position. The *loss* of an alternative in a line is the score of the reading minus
/// the score of the alternative. An alternative *shares* a line with the reading if both have the
/// same roll in this line.
struct LineLoss {
    std::uint8_t line = 0;
    std::uint8_t loss = 0;
};

/// Places in the secondary sequences at which an alternative may have bits similar to those of the
/// reading. Each entry also contains a line that the alternative shares with the reading.
struct SimilarPlaceList {
    static constexpr int kMax = 3072;
    struct Entry {
        std::uint8_t sequence;
        std::uint8_t place;
        std::uint8_t line;
    };
    int max_count = 512;  ///< at most kMax
    /// Places that lose at least this value, by a lower bound in the unit of `LineLoss::loss`, are
    /// counted, but not listed. At most 255.
    int unlisted_limit = 255;
    int count = 0;
    int unlisted_count = 0;
    std::array<Entry, kMax> places;
};

/// Set of places in a sequence, one bit per place. Bit 0 of the first word is the first place.
using PlaceBits = std::array<std::uint32_t, 8>;

/// Lower bounds on the loss of an alternative at each step. A step consists of two adjacent lines.
/// If the digit of the alternative differs from the digit of the reading at a step, the alternative
/// shares at most one of the two lines, and therefore loses at least this bound. The unit is
/// 1/kLimitParts of the loss limit.
struct StepLosses {
    static constexpr int kLimitParts = 8;
    int count = 0;
    std::array<std::uint8_t, 64> parts;  ///< bound for each step; at most kLimitParts
};

/// Groups of alternatives that differ from the reading in two or more sequences (see
/// `kAlternativeSets` in core/integrity/alternative_sets.hpp). Unused groups contain no
/// alternatives.
struct FarAlternatives {
    /// For each group, the probability that an alternative has the same digits as the reading at a
    /// given step.
    std::array<float, 8> equal{1, 1, 1, 1, 1, 1, 1, 1};
    std::array<float, 8> number{};  ///< number of alternatives in each group
};

/// Sums of the smallest losses. Element n is the sum of the n smallest losses, for n = 0 to 8.
using SmallestSums = std::array<std::int32_t, 9>;

/// Bits of 64 lines with 64 cells each, one word per line. A bit in `valid` is 1 if the
/// corresponding cell was read.
struct BitLines {
    std::array<std::uint64_t, 64> bits{};
    std::array<std::uint64_t, 64> valid{};
};

/// Function table for one kernel implementation.
struct Kernels {
    const char* name;
    /// Copies the image area of the patch, downscaled by `Patch::scale`, and surrounds it with a
    /// white margin.
    void (*fill_patch)(const ImageView& image, Patch& patch);
    /// Smooths the patch with a 1-2-1 filter along both axes. Stores the brightest and the darkest
    /// level of each tile. The brightest level excludes the pixels at the patch border, because the
    /// filter mixes these pixels with the white margin.
    void (*smooth_patch)(Patch& patch);
    /// Lists the dots. A dot is a minimum of the smoothed patch that is no brighter than the
    /// threshold of its tile. Minima in the two outermost rows and columns are ignored. The
    /// coordinates are in image px relative to the patch centre. They are refined to sub-pixel
    /// accuracy with parabolas through the minimum and its neighbours.
    void (*find_minima)(Patch& patch);
    /// Returns the strongest pair of perpendicular waves with frequency `per_px`, in cycles per px.
    /// Tries 12 directions in steps of 7.5 degrees.
    Waves (*strongest_waves)(const float* x, const float* y, int count, float per_px);
    /// Returns the strongest wave, together with the strongest other wave that forms plausible
    /// cells with the first one. Plausible cells have an area near 1 / per_px^2. Tries 40
    /// directions in steps of 4.5 degrees, and frequencies from 0.6 to 1.63 times `per_px`. If no
    /// other wave forms plausible cells, the power is 0.
    Waves (*strongest_skewed_waves)(const float* x, const float* y, int count, float per_px);
    /// Assigns each dot to a cell. Returns the sums of `CellSums` over the dots that are near a dot
    /// position of their cell.
    CellSums (*sum_cells)(const PatchDots& dots, const FloatPlane& plane, const CellPass& pass);
    /// Sets the bits of cells whose dots are clearly at one of the four dot positions. The first
    /// column and the first row intersect at cell (-32, -32). A bit is invalid if two dots in a
    /// cell disagree. The bits of a cell with three or more dots may be wrong.
    void (*read_cells)(const PatchDots& dots, const FloatPlane& plane, float displacement,
                       BitLines& columns, BitLines& rows);
    /// Scores a line of 64 cells at each roll. Each valid cell adds 127 if its bit agrees with the
    /// main sequence, and subtracts 127 otherwise.
    void (*score_line)(std::uint64_t bits, std::uint64_t valid, ScoredLine& line);
    /// Scores all lines at each of `positions` consecutive positions of the first line. sums[i]
    /// contains the total scores at the i-th position, indexed by an offset that is added to every
    /// roll. `rolls` contains the rolls of consecutive lines of the code, starting at the first
    /// position.
    void (*sum_rolls)(const RollScores& scores, const std::uint8_t* rolls, int positions,
                      RollSums* sums);
    /// Lists the cells in view, with their window centres and coded symbols. Sets `x` and `y` to
    /// the expected image points of the dots, including lens distortion. Stops when `dots` is full.
    void (*list_cells)(const CellsInView& view, MeasuredDots& dots);
    /// Finds the common shift from the window centres to the dots. Adds up the pixels around the
    /// first 16 dots that are far enough from the image border, and finds the darkest point of the
    /// summed image. Searches shifts up to `max_px` along each axis, in steps of `step_px`, with at
    /// most 6 steps per direction. Sets `cut_q8` to the contrast at the darkest point, in 1/256 of
    /// the paper level. Returns false if fewer than 8 dots are far enough from the border, or if
    /// the summed image is black.
    bool (*find_shift)(const ImageView& image, const MeasuredDots& dots, int max_px, int step_px,
                       FixedVec& shift_px, int& cut_q8);
    /// Sets `x` and `y` to the centroids of the dark pixels in the windows of the dots. Drops dots
    /// whose mass is less than 1/4 or more than 3.5 times the typical mass. Returns the typical
    /// mass relative to the paper level.
    float (*measure_windows)(const ImageView& image, const CellsInView& view,
                             const WindowOptions& options, MeasuredDots& dots);
    /// Replaces each centre with the weighted centroid of the centroid window around it. No
    /// threshold is applied, because a threshold would bias the centres. `radius_px` is at most
    /// kMaxCentroidRadius_px, and is reduced near the image border. Corrections of 1 px or more are
    /// not applied. Does nothing if the image is smaller than a window.
    void (*refine_centres)(const ImageView& image, const CellsInView& view, float radius_px,
                           MeasuredDots& dots);
    /// Reads cell bits from the grey levels at the four dot positions. The dot is assumed to be at
    /// the darkest position, so the dot positions must be predicted to within a fraction of the
    /// displacement. `dot_contrast_q8` is the contrast of a typical dot, in 1/256 of the paper
    /// level. Compares the bits with the code, and adds them to `columns` and `rows`, as
    /// `read_bits` does. Drops dots that are not read or have a wrong bit. Sets `projected` and
    /// `squares` to 0. Reads no bits if stride_bytes * height_px of the image exceeds INT32_MAX.
    BitsRead (*read_levels)(const ImageView& image, const CellsInView& view, int dot_contrast_q8,
                            MeasuredDots& dots, BitLines* columns, BitLines* rows);
    /// Measures predicted dots as `refine_centres` does, with radius kPredictedCentroidRadius_px.
    /// Drops dots whose offset exceeds `max_off_px`. The offset of a dot along an axis is
    /// `weight_px` times the first moment of its window along this axis, divided by the weighted
    /// darkness sum of the window. If `weight_px` is 0, the factor is estimated from dots in the
    /// middle of the list. Returns the sums of `DotOffsets` over the remaining dots.
    DotOffsets (*find_centres)(const ImageView& image, const CellsInView& view, float max_off_px,
                               float weight_px, MeasuredDots& dots);
    /// Reads the bits of measured dots and compares them with the code. Adds the bits to `columns`
    /// and `rows`, unless either pointer is null. The first column and the first row intersect at
    /// cell (-32, -32). The lines must be empty on entry, and no cell may have two dots.
    BitsRead (*read_bits)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                          BitLines* columns, BitLines* rows);
    /// Returns the sums of `FitSums` over the inliers. A dot is an inlier if its squared residual
    /// is at most `limit`, in spacings^2. `scale` is the unit of (u, v), in spacings.
    FitSums (*sum_fit)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                       float scale, float limit);
    /// Sums the residuals of the inliers (see `sum_fit`) in each block of a square grid. The grid
    /// has `side` blocks along each axis, and its border is `reach_px` from the plane centre in
    /// each direction. Dots outside the grid are added to the nearest block.
    BlockSums (*sum_blocks)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                            float limit, float reach_px, int side);
    /// Returns the places in a sequence where an alternative may lose less than the loss limit
    /// (StepLosses::kLimitParts parts). The result excludes `own`, the place of the reading.
    /// `steps` contains a lower bound on the loss at each step.
    PlaceBits (*find_similar_places)(const code::Secondary& sequence, std::uint32_t own,
                                     const StepLosses& steps);
    /// Returns an upper bound on the expected total odds of the far alternatives in `sets`. A far
    /// alternative shares at most `max_shared` adjacent lines with the reading. `best[i]` is the
    /// maximum odds in line i over all rolls except the roll of the reading.
    float (*sum_far_alternatives)(std::span<const float> best, int max_shared,
                                  const FarAlternatives& sets);
    /// Lists the places where an alternative that shares one of the given lines may lose less than
    /// `loss_limit` in the other lines. Places whose lower bound is at least `list.unlisted_limit`
    /// are counted, but not listed. Searches the sequences whose bit is set in `sequences`, and
    /// skips `own`, the places of the reading. The lines must be sorted by decreasing loss. Returns
    /// false if
    /// - there are too many places to list,
    /// - there are fewer than two lines,
    /// - there are exactly five or seven lines, and only their total loss reaches `loss_limit`,
    /// - `loss_limit` exceeds 200, or
    /// - an alternative that shares none of the first eight lines may lose less than `loss_limit`.
    bool (*list_similar_places)(const code::Basis& basis, const std::array<std::uint32_t, 4>& own,
                                unsigned sequences, std::span<const LineLoss> lines, int loss_limit,
                                SimilarPlaceList& list);
    /// Sets `sums[n]` to the sum of the n smallest losses, for n = 0 to 8. `losses` must have 8 to
    /// 16 elements. Negative losses are treated as 0.
    void (*sum_smallest_losses)(std::span<const std::int16_t> losses, SmallestSums& sums);
};

}  // namespace dotpose::core
