// Kernels: loops over pixels, dots and cells. The desktop attempts spend most of their time in
// these loops. Each kernel has several implementations, one per kind of processor, with
// bit-identical results. `select.hpp` selects one implementation. Floating-point numbers are in
// single precision. Lengths in the image are in px.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "code/tables.hpp"
#include "core/kernels/scores.hpp"
#include "core/math/float_plane.hpp"
#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Two plane waves cos(2 pi (kx x + ky y) - phase). The wave vectors (kx, ky) have a positive cross
/// product.
struct Waves {
    /// Components of the wave vectors of the first and of the second wave, in cycles per px.
    std::array<float, 2> kx{};
    std::array<float, 2> ky{};
    float power = 0;  ///< sum of the powers of both waves; about 2 n^2 for n dots on intersections
    /// Sums of the cosine and of the sine of 2 pi (kx x + ky y) over all dots. The phase is
    /// atan2(phase_sin, phase_cos).
    std::array<float, 2> phase_cos{};
    std::array<float, 2> phase_sin{};
};

/// Options of `sum_cells`, which assigns dots to cells in one pass.
struct CellPass {
    float reach_px = 0;  ///< maximum distance of a dot from the origin along each axis
    /// Maximum distance of a dot from the nearest place of its cell, in spacings. Dots at a larger
    /// distance are not used.
    float max_off = 0;
    /// Distance of the four places of a cell from its intersection, in spacings. If it is 0, the
    /// intersection is the only place.
    float displacement = 0;
    bool with_perspective = false;
};

/// Sums over the used dots of one pass, for the least-squares plane with perspective: i (1 + g x +
/// h y) = a x + b y + c, and j (1 + g x + h y) = d x + e y + f. (x, y) is the image point of a dot,
/// and (i, j) is the nearest place of its cell. Without perspective, only the first three elements
/// of `i` and `j` are set, and `square` is 0.
struct CellSums {
    float seen = 0;  ///< number of dots within reach
    float used = 0;  ///< number of `seen` dots within `max_off` of a place
    /// Sum of the squared distances of the used dots from their places, in spacings^2.
    float squares = 0;
    std::array<float, 6> one{};     ///< sums of 1, x, y, xx, xy, yy
    std::array<float, 6> i{};       ///< the same six sums, with each term multiplied by i
    std::array<float, 6> j{};       ///< the same six sums, with each term multiplied by j
    std::array<float, 6> square{};  ///< the same six sums, with each term multiplied by i^2 + j^2
};

/// Maximum number of columns, and of rows, of cells in view, at any rotation of the image.
inline constexpr int kMaxLinesInView = 1024;

/// Placement of the windows by `list_cells`: no windows, on intersections or on dots.
enum class Windows : std::uint8_t { none, on_intersections, on_dots };

/// Options of `list_cells`, which lists the cells whose dots are in view.
struct CellsInView {
    /// Plane from the image to the upright pattern. Image points are relative to (centre_x,
    /// centre_y).
    FloatPlane plane;
    FloatLens lens;
    float centre_x = 0;  ///< origin of image points, in px relative to the first pixel of the image
    float centre_y = 0;
    float width_px = 0;
    float height_px = 0;
    float margin_px = 0;  ///< minimum distance of a dot from the border of the image
    /// Maximum distance of the undistorted image point of a dot from (centre_x, centre_y), along
    /// each axis.
    float reach_px = 0;
    float displacement = 0;  ///< distance of dots from their intersections, in spacings
    Windows windows = Windows::on_intersections;
    int step = 1;  ///< row subsampling step: every `step`-th cell of a row is listed
    /// For each column, the index in the main sequence of its cell in row `first_row`. `row_rolls`
    /// contains, for each row, the index of its cell in column `first_column`.
    const std::uint8_t* column_rolls = nullptr;
    const std::uint8_t* row_rolls = nullptr;
    int first_column = 0;  ///< column of the first element of `column_rolls`
    int first_row = 0;
    int columns = 0;
    int rows = 0;
};

/// Options of `measure_windows`.
struct WindowOptions {
    float spacing_px = 11;  ///< spacing at the centre of the view
    /// Half the side of a window, in spacings. The half side in px is limited to the range from 2
    /// to kMaxHalfWindow_px.
    float reach = 0.36F;
    /// Minimum contrast of a pixel of a dot, in 1/256 of the paper level.
    int cut_q8 = 128;
    /// Mass of a typical dot relative to the paper level, or 0 to determine this mass from the
    /// windows.
    float typical_mass = 0;
};
/// Maximum half side of a window, and maximum radius of a centroid window.
inline constexpr int kMaxHalfWindow_px = 24;
inline constexpr float kMaxCentroidRadius_px = 24;
/// Maximum radius of a small centroid window. Small windows take a tenth of the time of larger
/// windows.
inline constexpr float kSmallCentroidRadius_px = 4;
/// Radius of the centroid window for predicted dots. Small enough to limit noise, and large enough
/// to include the edge of the dot at 8 to 13 px per spacing.
inline constexpr float kPredictedCentroidRadius_px = 3.65F;

/// Sums over the inliers for the fit of nine parameters; see PlaneNormal. (u, v) is the place of a
/// dot on the pattern, relative to `at` of the plane, in units of the `scale` of `sum_fit`. (x, y)
/// is the residual of the dot, in spacings.
struct FitSums {
    int points = 0;      ///< number of inliers
    int outliers = 0;    ///< number of measured dots that are not inliers
    float farthest = 0;  ///< largest squared residual of an inlier
    /// Sum of the offsets from the intersections, each projected onto the direction of the
    /// displacement in the code.
    float projected = 0;
    float squares = 0;  ///< sum of the squared residuals
    /// Sums of 1, u, v, uu, uv, vv, uuu, uuv, uvv, vvv, quu, quv, qvv, qqu, qqv and qqq, with q =
    /// uu + vv.
    std::array<float, 16> places{};
    /// Sums of x, y, xu, yv, yu, xv, au, av and aq, with a = xu + yv.
    std::array<float, 9> residuals{};
};

/// Sums over predicted dots. The place of a dot is its predicted image point, in px relative to the
/// centre of the view. The offset of a dot is its measured centre minus its place, in px.
struct DotOffsets {
    int points = 0;
    float u = 0;  ///< sum of places
    float v = 0;
    float squares = 0;  ///< sum of the squared distances of the places from the centre of the view
    float squared = 0;  ///< sum of the squared offsets
    float off_u = 0;    ///< sum of offsets
    float off_v = 0;
    /// Sum of the inner products of place and offset. `across` is the sum of their cross products.
    float along = 0;
    float across = 0;
    /// Sums of the offsets along u and along v, each times the x component of the displacement
    /// direction of its dot. `of_y` contains the sums for the y component.
    std::array<float, 2> of_x{};
    std::array<float, 2> of_y{};
};

/// Sums of residuals, in spacings, over the inliers in each square block of the image.
struct BlockSums {
    static constexpr std::size_t kMaxAlong = 9;
    struct Block {
        float dots = 0;  ///< number of inliers
        float off_x = 0;
        float off_y = 0;
    };
    std::array<Block, kMaxAlong * kMaxAlong> all;
    float dots = 0;      ///< number of inliers
    float outliers = 0;  ///< number of measured dots that are not inliers
    float squares = 0;   ///< sum of the squared residuals of the inliers, in spacings^2
};

/// Result of reading the bits of cells and comparing them with the code.
struct BitsRead {
    int seen = 0;     ///< number of cells with a dark spot
    int read = 0;     ///< number of `seen` cells whose spot is clearly at one of the four places
    int wrong_x = 0;  ///< number of `read` cells whose x bit contradicts the code
    int wrong_y = 0;
    int right = 0;  ///< number of `read` cells without a wrong bit
    /// Sum, over the `right` dots, of the larger component of their offset from the intersection,
    /// in spacings.
    float projected = 0;
    /// Sum of the squared distances of `right` dots from their places, in spacings^2.
    float squares = 0;
};

/// A line, and the minimum loss, in bits, of an alternative that does not share this line with the
/// reading.
struct LineLoss {
    std::uint8_t line = 0;
    std::uint8_t loss = 0;
};

/// List of places in the secondary sequences, each with a line that an alternative at this place
/// shares with the reading.
struct SimilarPlaceList {
    static constexpr int kMax = 512;
    struct Entry {
        std::uint8_t sequence;
        std::uint8_t place;
        std::uint8_t line;
    };
    int count = 0;
    std::array<Entry, kMax> places;
};

/// Set of places in a sequence, one bit per place. Bit 0 of the first word is the first place.
using PlaceBits = std::array<std::uint32_t, 8>;

/// For each step, which is a pair of adjacent lines, a lower bound on the loss of an alternative
/// whose digit in this step differs from the digit of the reading. Such an alternative does not
/// share at least one of the two lines. The unit is 1/kLimitParts of the loss limit.
struct StepLosses {
    static constexpr int kLimitParts = 8;
    int count = 0;
    std::array<std::uint8_t, 64> parts;  ///< loss of each step; at most kLimitParts
};

/// Groups of alternatives. The alternatives of a group differ from the reading in the same set of
/// sequences. For each group, contains the probability that, in one step, all digits of an
/// alternative equal the digits of the reading (`equal`), and the number of alternatives
/// (`number`).
struct FarAlternatives {
    std::array<float, 8> equal{1, 1, 1, 1, 1, 1, 1, 1};
    std::array<float, 8> number{};
};

/// Roll offsets of 32 combinations of places in some of the sequences, indexed by line.
struct OffsetBatch {
    std::array<std::array<std::uint8_t, 32>, kMaxLines> offsets;
};

/// Odds by roll offset. The last element is padding.
using OddsByOffset = std::array<float, kRollEntries>;

/// Lower bound on the odds of an alternative in a line, in the elements of `OddsByOffset` other
/// than the padding. Avoids denormal numbers, which are slow.
inline constexpr float kMinOddsOfOffset = 0x1p-40F;

/// Expected odds by the number of shared anchors, up to 6.
using OddsByShared = std::array<float, 7>;

/// Sums of the n smallest losses, indexed by n, from 0 to 8.
using SmallestSums = std::array<std::int32_t, 9>;

/// Bits of 64 lines of 64 cells, one word per line. In `valid`, the bit of a cell is 1 if the cell
/// was read.
struct BitLines {
    std::array<std::uint64_t, 64> bits{};
    std::array<std::uint64_t, 64> valid{};
};

/// Function table of one implementation of the kernels, such as portable or AVX2.
struct Kernels {
    const char* name;
    /// Copies the part of the image that the patch covers, reduced by the scale of the patch, and
    /// adds a white margin.
    void (*fill_patch)(const ImageView& image, Patch& patch);
    /// Smooths the patch with a 1-2-1 filter along both axes, and determines the brightest and the
    /// darkest smoothed pixel of each tile. Excludes the outermost pixels of the patch from the
    /// brightest pixels, because the white margin brightens them.
    void (*smooth_patch)(Patch& patch);
    /// Lists the dots: the minima of the smoothed patch that are not brighter than the threshold of
    /// their tile. The place of a dot is the vertex of the parabolas through the minimum and its
    /// neighbouring pixels, in px of the image relative to the middle of the patch. Ignores minima
    /// in the two outermost rows or columns on each side of the patch.
    void (*find_minima)(Patch& patch);
    /// Evaluates a pair of perpendicular waves with a frequency of `per_px` cycles per px in each
    /// of 12 directions (steps of 7.5 degrees). Returns the pair with the highest power.
    Waves (*strongest_waves)(const float* x, const float* y, int count, float per_px);
    /// Evaluates single waves in 40 directions (steps of 4.5 degrees), with frequencies from 0.6 to
    /// 1.63 times `per_px`. Returns the strongest wave, paired with the strongest wave that forms
    /// cells of about the area 1 / per_px^2 with the first wave. If there is no such pair, the
    /// power is 0.
    Waves (*strongest_skewed_waves)(const float* x, const float* y, int count, float per_px);
    /// Assigns the dots to cells. Returns the sums over the dots that are near a place of their
    /// cell.
    CellSums (*sum_cells)(const PatchDots& dots, const FloatPlane& plane, const CellPass& pass);
    /// Sets the bits of the cells whose dots are clearly at one of the four places. The first
    /// column and the first row are those of cell (-32, -32).
    void (*read_cells)(const PatchDots& dots, const FloatPlane& plane, float displacement,
                       BitLines& columns, BitLines& rows);
    /// Scores a line of 64 cells at each roll. Each valid cell adds 127 if its bit agrees with the
    /// main sequence, and subtracts 127 if it does not.
    void (*score_line)(std::uint64_t bits, std::uint64_t valid, ScoredLine& line);
    /// Sums the scores of all lines for each of `positions` consecutive positions of the first
    /// line. `rolls` contains the rolls of consecutive lines, beginning with the line at the first
    /// position.
    void (*sum_rolls)(const RollScores& scores, const std::uint8_t* rolls, int positions,
                      RollSums* sums);
    /// Lists the cells in view, with the centres of their windows and their symbols in the code.
    /// Sets `x` and `y` to the expected image points of the dots, including lens distortion. Stops
    /// when `dots` is full.
    void (*list_cells)(const CellsInView& view, MeasuredDots& dots);
    /// Adds the images around the first 16 dots whose surroundings are completely in the image, and
    /// finds the shift from the window centre to the darkest point of the sum. Tests shifts along
    /// each axis up to `max_px`, in steps of `step_px`, but at most 6 steps in each direction. Sets
    /// `cut_q8` to the contrast at this shift relative to the paper level, in 1/256. Returns false
    /// if there are fewer than 8 dots with complete surroundings, or if these surroundings are
    /// black.
    bool (*find_shift)(const ImageView& image, const MeasuredDots& dots, int max_px, int step_px,
                       FixedVec& shift_px, int& cut_q8);
    /// Sets `x` and `y` to the centroids of the dark pixels in the windows of the dots. Drops dots
    /// whose mass is less than a quarter or more than 3.5 times the mass of a typical dot. Returns
    /// the mass of a typical dot relative to the paper level.
    float (*measure_windows)(const ImageView& image, const CellsInView& view,
                             const WindowOptions& options, MeasuredDots& dots);
    /// Replaces the centres with weighted centroids, computed in centroid windows. Applies no
    /// threshold, because a threshold would bias the centres. `radius_px` is at most
    /// kMaxCentroidRadius_px. Windows at the border of the image are smaller. Ignores corrections
    /// of 1 px or more. Does nothing if the windows do not fit in the image.
    void (*refine_centres)(const ImageView& image, const CellsInView& view, float radius_px,
                           MeasuredDots& dots);
    /// Reads the bits of cells whose dots are predicted to within a fraction of their displacement.
    /// The dot is assumed to be at the darkest of the four places of its cell. `depth_q8` is the
    /// contrast of a typical dot relative to the paper level, in 1/256. Bits are compared and added
    /// to lines as in `read_bits`. Drops dots that are not read or have a wrong bit. Does not
    /// compute `projected` and `squares`.
    BitsRead (*read_levels)(const ImageView& image, const CellsInView& view, int depth_q8,
                            MeasuredDots& dots, BitLines* columns, BitLines* rows);
    /// Measures the centres of predicted dots as `refine_centres` does, in windows with a radius of
    /// kPredictedCentroidRadius_px. Drops dots with an offset above `max_off_px`. `weight_px` is
    /// the offset, in px, that corresponds to a moment-to-weight ratio of 1, or 0 to estimate this
    /// offset from dots in the middle of the list. Returns the sums over the remaining dots.
    DotOffsets (*find_centres)(const ImageView& image, const CellsInView& view, float max_off_px,
                               float weight_px, MeasuredDots& dots);
    /// Reads the bits of measured dots and compares them with the code. Adds the bits to `columns`
    /// and `rows`, unless one of these pointers is null. The first column and the first row are
    /// those of cell (-32, -32). The lines must be empty, and no cell may have two dots.
    BitsRead (*read_bits)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                          BitLines* columns, BitLines* rows);
    /// Returns the sums over the inliers, whose squared residuals are at most `limit` (in
    /// spacings^2). `scale` is the unit of places, in spacings.
    FitSums (*sum_fit)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                       float scale, float limit);
    /// Adds up the residuals of the inliers, whose squared residuals are at most `limit` (in
    /// spacings^2), in `side` x `side` blocks. The blocks cover the image points up to `reach_px`
    /// from the centre of the plane along both axes. Dots outside belong to the nearest block.
    void (*sum_blocks)(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                       float limit, float reach_px, int side, BlockSums& sums);
    /// Returns the places of a sequence where the lower bound on the loss, computed from `steps`,
    /// is below the loss limit. Excludes the place `own` of the reading.
    PlaceBits (*find_similar_places)(const code::Secondary& sequence, std::uint32_t own,
                                     const StepLosses& steps);
    /// Returns the expected odds of the far alternatives. `best` contains, for each line, the odds
    /// of the best roll other than the roll of the reading. A far alternative shares at most
    /// `max_shared` adjacent lines with the reading.
    float (*sum_far_alternatives)(std::span<const float> best, int max_shared,
                                  const FarAlternatives& sets);
    /// Lists the places where an alternative may lose less than `loss_limit` over the given lines.
    /// Excludes the places of the reading (`own`). Searches the sequences whose bit is set in
    /// `sequences`. The lines must be sorted by decreasing loss. Returns false if there are too
    /// many places, if there are fewer than two lines, if the limit exceeds 200, or if an
    /// alternative that shares none of the first eight lines may lose less than the limit. Also
    /// returns false if more than four lines are needed for this, and there are fewer than eight.
    bool (*list_similar_places)(const code::Basis& basis, const std::array<std::uint32_t, 4>& own,
                                unsigned sequences, std::span<const LineLoss> lines, int loss_limit,
                                SimilarPlaceList& list);
    /// Sets `sums[n]` to the sum of the n smallest losses, for n = 0 to 8. `losses` must have 8 to
    /// 16 elements. Negative losses count as 0.
    void (*sum_smallest_losses)(std::span<const std::int16_t> losses, SmallestSums& sums);
    /// Returns which of the 32 combinations of a batch may lose less than `limit` (at most 255),
    /// one bit per combination, together with one combination of places in the other sequences.
    /// `losses` contains the loss in each line that is not shared. A line is shared if the offset
    /// in the batch equals `opposite`, the negative of the offset of the other combination.
    std::uint32_t (*similar_in_batch)(const OffsetBatch& batch, const std::uint8_t* opposite,
                                      std::span<const std::uint8_t> losses, int limit);
    /// Returns the expected odds of the alternatives that differ from the reading in the places in
    /// the given sequences (`different`, one bit per sequence), and share at most `max_shared` (up
    /// to 8) adjacent lines. The digits of the alternatives are uniform. `places` are the places of
    /// the first line. `lines` contains the odds of an alternative in each line. The odds at offset
    /// 0 are 1, and the padding is 0.
    float (*sum_expected_alternatives)(const code::Basis& basis,
                                       const std::array<std::uint32_t, 4>& places,
                                       unsigned different, std::span<const OddsByOffset> lines,
                                       int max_shared);
    /// Computes the expected odds of the alternatives that differ from the reading in the places in
    /// two sequences, by the number of anchors that they share. Alternatives that share more than 6
    /// anchors are not included. Bit n of `anchors` is 1 if line n is an anchor. The other
    /// arguments are those of `sum_expected_alternatives`.
    void (*sum_expected_doubles)(const code::Basis& basis,
                                 const std::array<std::uint32_t, 4>& places,
                                 std::span<const OddsByOffset> lines, std::uint64_t anchors,
                                 OddsByShared& totals);
};

}  // namespace dotpose::core
