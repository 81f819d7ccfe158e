#include "device/fine_grid.hpp"

#include <algorithm>
#include <array>

#include "core/math/fixed.hpp"
#include "core/noinline.hpp"
#include "device/coded_cells.hpp"
#include "device/fine_dots.hpp"
#include "device/offset_fit.hpp"
#include "device/predicted.hpp"

namespace dotpose::core {
namespace {

constexpr int kMinDots = 12;
constexpr std::int32_t kOneCell_q24 = 1 << 24;
/// Maximum offset of a dot from its expected centre along each axis: an eighth of the spacing.
constexpr std::int32_t kMaxOffset_q24 = kOneCell_q24 / 8;

/// Circular mean of phases. The phase of a coordinate is its fractional part, in cells. Uses
/// triangle waves instead of cosine and sine, because triangle waves need neither a table nor a
/// multiplication.
class MeanPhase {
  public:
    /// Adds a coordinate, in 2^-8 cells.
    void add(std::int32_t coordinate_q8) {
        constexpr int kQuarter_q8 = 64;
        cosine_ += kQuarter_q8 - magnitude<int>(static_cast<std::int8_t>(coordinate_q8));
        sine_ +=
            kQuarter_q8 - magnitude<int>(static_cast<std::int8_t>(coordinate_q8 - kQuarter_q8));
    }
    /// Returns the phase, in 2^-8 cells.
    int q8() const {
        const int size = std::max(magnitude(cosine_) + magnitude(sine_), 1);
        const int part = 64 * sine_ / size;
        if (cosine_ >= 0) return part;
        return (sine_ >= 0 ? 128 : -128) - part;
    }

  private:
    int cosine_ = 0;
    int sine_ = 0;
};

/// Phases along one axis, averaged separately over the two halves of the view. A rotation of the
/// grid changes the phases of the two halves in opposite directions.
class PhasesOfAxis {
  public:
    /// Adds a dot. `coordinate_q8` is its coordinate along this axis. `across_q8` is its signed
    /// distance from the image centre along the other axis. Both are in 2^-8 cells.
    void add(std::int32_t coordinate_q8, std::int32_t across_q8) {
        halves_[across_q8 < 0 ? 0 : 1].add(coordinate_q8);
        across_q8_ += magnitude(across_q8);
    }
    struct Line {
        int shift_q8;            ///< phase at the image centre, in 2^-8 cells
        std::int32_t slope_q16;  ///< change of the phase per cell along the other axis
    };
    Line fit(int dots) const {
        const int first_q8 = halves_[0].q8();
        const int rise_q8 = static_cast<std::int8_t>(halves_[1].q8() - first_q8);
        // The slope is `rise_q8` divided by the distance between the centroids of the two halves.
        // This distance is twice the mean distance of a dot from the line between the halves.
        return {static_cast<std::int8_t>(first_q8 + rise_q8 / 2),
                (rise_q8 * dots * (1 << 15)) / std::max<std::int32_t>(across_q8_, 1)};
    }

  private:
    std::array<MeanPhase, 2> halves_;
    std::int32_t across_q8_ = 0;
};

/// A dot with its cell, its offset from the intersection in 2^-24 cells, and its symbol.
struct ReadDot {
    FixedVec cell;
    FixedVec from_intersection_q24;
    Symbol symbol;
};

class FineGrid {
  public:
    FineGrid(Tracking& tracking, PlaneFromImage& plane)
        : tracking_(tracking), plane_(plane), displacement_q24_(tracking.displacement_q12 << 12) {
        take_slopes();
        drop_unlike_dots(tracking);
    }

    int dots() const { return tracking_.dots_measured; }
    /// Shifts and rotates the plane to match the phases of the dots near the image centre.
    void fit_phases();
    /// Improves the plane by fitting it to every second dot, first near the image centre and then
    /// farther out.
    void fit_roughly();
    /// Reads the bits of all dots, and fits the plane. Stores the bits in ComparedLine::wrong until
    /// they are compared with the code. Returns the number of dots in the fit, or 0 if the dots do
    /// not determine a plane.
    int read_and_fit();

    /// Returns the phase of the grid at the image centre along each axis, in 2^-8 cells.
    FixedVec phase_q8() const { return phase_q8_; }
    std::int32_t displacement_q16() const { return displacement_q24_ >> 8; }

  private:
    std::span<const DetectedDot> all() const {
        return tracking_.found.first(static_cast<std::size_t>(dots()));
    }
    void take_slopes() {
        du_q16_ = {plane_.du_q24.x >> 8, plane_.du_q24.y >> 8};
        dv_q16_ = {plane_.dv_q24.x >> 8, plane_.dv_q24.y >> 8};
        at_q24_ = {plane_.at_centre_q16.x * 256, plane_.at_centre_q16.y * 256};
    }
    FixedVec from_middle_q24(const DetectedDot& dot) const {
        return {du_q16_.x * dot.centre_q8.x + dv_q16_.x * dot.centre_q8.y,
                du_q16_.y * dot.centre_q8.x + dv_q16_.y * dot.centre_q8.y};
    }
    ReadDot read(const DetectedDot& dot) const;
    /// Returns the offset of a dot from the centre that is expected for its symbol.
    FixedVec offset_q24(const ReadDot& dot) const {
        return dot.from_intersection_q24 -
               FixedVec{dx(dot.symbol) * displacement_q24_, dy(dot.symbol) * displacement_q24_};
    }
    void note(const ReadDot& dot);
    /// Fits the plane to every second dot whose distance from the image centre is at most
    /// `reach_q8` along each axis.
    void fit_within(std::int32_t reach_q8);

    Tracking& tracking_;
    PlaneFromImage& plane_;
    FixedVec du_q16_;
    FixedVec dv_q16_;
    FixedVec at_q24_;
    FixedVec phase_q8_;
    std::int32_t displacement_q24_;
};

DOTPOSE_NOINLINE void FineGrid::fit_phases() {
    PhasesOfAxis along_x;
    PhasesOfAxis along_y;
    const FixedVec middle_q8{at_q24_.x >> 16, at_q24_.y >> 16};
    // Maximum distance of the dots from the image centre along each axis: 3.5 cells. Dots farther
    // out are not used, because an error of the predicted rotation may move their predicted centres
    // by more than half a spacing.
    constexpr std::int32_t kNear_q8 = 7 * 128;
    int count = 0;
    for (const DetectedDot& dot : all()) {
        const FixedVec p_q24 = from_middle_q24(dot);
        const FixedVec p_q8{p_q24.x >> 16, p_q24.y >> 16};
        if (!is_within(p_q8, kNear_q8)) continue;
        ++count;
        along_x.add(middle_q8.x + p_q8.x, p_q8.y);
        along_y.add(middle_q8.y + p_q8.y, p_q8.x);
    }
    const PhasesOfAxis::Line x = along_x.fit(count);
    const PhasesOfAxis::Line y = along_y.fit(count);
    phase_q8_ = {x.shift_q8, y.shift_q8};
    plane_.at_centre_q16 = plane_.at_centre_q16 - FixedVec{x.shift_q8 * 256, y.shift_q8 * 256};
    const std::int32_t turn_q12 = (y.slope_q16 - x.slope_q16) >> 5;
    const auto turn_back = [turn_q12](FixedVec& slope_q24) {
        slope_q24 =
            slope_q24 + FixedVec{(slope_q24.y >> 12) * turn_q12, -(slope_q24.x >> 12) * turn_q12};
    };
    turn_back(plane_.du_q24);
    turn_back(plane_.dv_q24);
    take_slopes();
}

[[gnu::always_inline]] inline ReadDot FineGrid::read(const DetectedDot& dot) const {
    constexpr std::int32_t kHalf_q24 = kOneCell_q24 / 2;
    const FixedVec p_q24 = from_middle_q24(dot) + at_q24_ + FixedVec{kHalf_q24, kHalf_q24};
    const FixedVec from_q24{(p_q24.x & (kOneCell_q24 - 1)) - kHalf_q24,
                            (p_q24.y & (kOneCell_q24 - 1)) - kHalf_q24};
    return {{p_q24.x >> 24, p_q24.y >> 24},
            from_q24,
            symbol_of({from_q24.y - from_q24.x, from_q24.y + from_q24.x})};
}

void FineGrid::fit_roughly() {
    // Maximum distance of the dots in the first fit, in cells (approximate). With an error of the
    // predicted rotation, the symbols of dots farther out may be misread.
    constexpr int kFirstReach = 8;
    const int cells = (tracking_.last_cell - tracking_.first_cell + 1) / 2;
    const int width_px = tracking_.width_px - 2 * tracking_.left_out_px;
    const std::int32_t whole_q8 = 128 * (width_px + tracking_.height_px);
    for (int reach = kFirstReach; reach < cells; reach += 2)
        fit_within(whole_q8 * reach / cells);
    fit_within(whole_q8);
}

DOTPOSE_NOINLINE void FineGrid::fit_within(std::int32_t reach_q8) {
    // Every second dot is enough for this rough fit, because the measured centres deviate from the
    // dot positions of their cells by much less than the displacement that encodes the bits.
    OffsetFit fit;
    for (std::size_t i = 0; i < all().size(); i += 2) {
        const DetectedDot& dot = all()[i];
        if (!is_within(dot.centre_q8, reach_q8)) continue;
        const FixedVec off_q24 = offset_q24(read(dot));
        if (is_within(off_q24, kMaxOffset_q24)) fit.add(dot, off_q24);
    }
    if (fit.count() >= kMinDots / 2 && fit.correct(plane_)) take_slopes();
}

/// Records the bits of a dot. Ignores the dot if two of its four possible centres are almost
/// equally close to its measured centre, or if its cell is outside the tracked range.
DOTPOSE_NOINLINE void FineGrid::note(const ReadDot& dot) {
    const auto [cell, from_q24, symbol] = dot;
    const int first = tracking_.first_cell;
    const auto last = static_cast<unsigned>(tracking_.last_cell - first);
    const auto is_in = [first, last](int index) {
        return static_cast<unsigned>(index - first) <= last;
    };
    const std::int32_t difference_q24 = magnitude(from_q24.x) - magnitude(from_q24.y);
    if (magnitude(difference_q24) < displacement_q24_ / 4 || !is_in(cell.x) || !is_in(cell.y))
        return;
    ComparedLine& column = column_of(tracking_, cell.x);
    ComparedLine& row = row_of(tracking_, cell.y);
    const auto s = static_cast<std::uint32_t>(symbol);
    column.seen |= std::uint32_t{1} << cell.y;
    column.wrong |= (s & 1) << cell.y;
    row.seen |= std::uint32_t{1} << cell.x;
    row.wrong |= (s >> 1) << cell.x;
}

DOTPOSE_NOINLINE int FineGrid::read_and_fit() {
    OffsetFit fit;
    std::int32_t displacement_q16 = 0;
    for (const DetectedDot& dot : all()) {
        const ReadDot read_dot = read(dot);
        note(read_dot);
        const FixedVec off_q24 = offset_q24(read_dot);
        if (!is_within(off_q24, kMaxOffset_q24)) continue;
        fit.add(dot, off_q24);
        displacement_q16 += larger_component(read_dot.from_intersection_q24) >> 8;
    }
    if (fit.count() < kMinDots || !fit.correct(plane_)) return 0;
    displacement_q24_ = displacement_q16 / fit.count() * 256;
    return fit.count();
}

/// Returns the code bits of a line after the corner has moved by `line_shift` lines and by
/// `cell_shift` cells along the lines. Each shift is -1, 0 or 1.
std::uint32_t code_at(std::span<const ComparedLine> lines, int line, int line_shift,
                      int cell_shift) {
    const std::uint32_t bits = lines[static_cast<std::size_t>(line + line_shift)].code;
    return cell_shift >= 0 ? bits >> cell_shift : bits << 1;
}

/// Returns the number of bits along an axis that disagree with the code after the corner has moved
/// by the given shift.
int wrong_bits(const Tracking& tracking, std::span<const ComparedLine> lines, int line_shift,
               int cell_shift) {
    int wrong = 0;
    for (int line = tracking.first_cell; line <= tracking.last_cell; ++line) {
        const ComparedLine& read = lines[static_cast<std::size_t>(line)];
        if (read.seen == 0) continue;
        const std::uint32_t code = code_at(lines, line, line_shift, cell_shift);
        wrong += bits_in((code ^ read.wrong) & read.seen);
    }
    return wrong;
}

/// Returns true if at most a quarter of the bits of all dots disagree with the code after the
/// corner has moved by `shift` cells.
bool agrees(const Tracking& tracking, FixedVec shift) {
    const int wrong =
        wrong_bits(tracking, tracking.lines.first(kMaxComparedLines), shift.x, shift.y) +
        wrong_bits(tracking, tracking.lines.last(kMaxComparedLines), shift.y, shift.x);
    return 2 * wrong <= tracking.dots_measured;
}

/// Moves the corner by at most one cell along each axis, to a place where at least three quarters
/// of the bits agree with the code. Marks the bits that disagree with the code at this place.
/// Returns false if there is no such place. `phase_q8` is the shift of the grid relative to the
/// prediction.
DOTPOSE_NOINLINE bool find_place(FixedVec phase_q8, CodeVariant code, Tracking& tracking) {
    // The phase determines the shift of the pattern only modulo one cell. The maximum accepted
    // error of a prediction is 3/5 of a cell. If the magnitude of the phase is at least kLarge_q8,
    // a shift in the opposite direction, which differs from the phase by one cell, is therefore
    // also possible.
    constexpr int kLarge_q8 = 256 * 2 / 5;
    const auto other = [](int phase) {
        return magnitude(phase) < kLarge_q8 ? 0 : phase > 0 ? 1 : -1;
    };
    const FixedVec far{other(phase_q8.x), other(phase_q8.y)};
    for (const FixedVec shift : {FixedVec{}, FixedVec{far.x, 0}, FixedVec{0, far.y}, far}) {
        if (!agrees(tracking, shift)) continue;
        if (shift != FixedVec{}) {
            tracking.corner = moved(code, tracking.corner, shift.x, shift.y);
            lay_tracked_lines(code, tracking);
        }
        for (int i = tracking.first_cell; i <= tracking.last_cell; ++i) {
            for (ComparedLine* line : {&column_of(tracking, i), &row_of(tracking, i)})
                line->wrong = (line->wrong ^ line->code) & line->seen;
        }
        return true;
    }
    return false;
}

}  // namespace

int fit_fine_grid(CodeVariant code, Tracking& tracking, PlaneFromImage& plane,
                  std::int32_t& displacement_q16) {
    FineGrid grid(tracking, plane);
    if (grid.dots() < kMinDots) return 0;
    grid.fit_phases();
    grid.fit_roughly();
    const int used = grid.read_and_fit();
    displacement_q16 = grid.displacement_q16();
    return used > 0 && find_place(grid.phase_q8(), code, tracking) ? used : 0;
}

}  // namespace dotpose::core
