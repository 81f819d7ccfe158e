#include "device/turn.hpp"

#include <algorithm>

#include "core/math/fixed.hpp"
#include "device/coded_cells.hpp"
#include "device/near_dot.hpp"
#include "device/predicted.hpp"

namespace dotpose::core {
namespace {

/// Maximum number of rings of cells that are measured around the middle cell.
constexpr int kRounds = 4;
/// Minimum number of dots that agree with the code, and minimum fraction of the measured dots that
/// agree with it, in units of 1/8.
constexpr int kMinDots = 12;
constexpr int kMinFraction_q3 = 6;
/// The fraction is tested only if at least this number of dots has been measured.
constexpr int kMinMeasured = 8;

/// A small similarity transform of the cells: shift, rotation and scale. A cell at c, relative to
/// the middle cell, moves by shift + stretch c + turn J c, where J is a rotation by 90 degrees. The
/// transform is applied before the cell map. It therefore does not rotate the shear of a rolling
/// shutter, which is part of the cell map.
struct Similarity {
    std::int32_t stretch_q20 = 0;
    std::int32_t turn_q20 = 0;
    FixedVec shift_q12;  ///< in 2^-12 spacings
};

/// Returns stretch v + turn J v. This function is not inlined, because 64-bit products need a lot
/// of code.
[[gnu::noinline]] FixedVec change(const Similarity& s, FixedVec v) {
    const auto part = [](std::int64_t a_q20) { return static_cast<std::int32_t>(a_q20 >> 20); };
    return {part(std::int64_t{s.stretch_q20} * v.x - std::int64_t{s.turn_q20} * v.y),
            part(std::int64_t{s.stretch_q20} * v.y + std::int64_t{s.turn_q20} * v.x)};
}

/// Least-squares fit of a similarity transform to the offsets of dots.
class SimilarityFit {
  public:
    /// Adds a dot. `cell` is its cell, relative to the middle cell.
    void add(FixedVec cell, FixedVec offset_q12) {
        ++count_;
        cells_ = cells_ + cell;
        offset_ = offset_ + offset_q12;
        squares_ += cell.x * cell.x + cell.y * cell.y;
        along_ += cell.x * offset_q12.x + cell.y * offset_q12.y;
        across_ += cell.x * offset_q12.y - cell.y * offset_q12.x;
    }
    int count() const { return count_; }

    Similarity solve() const {
        const std::int32_t spread = count_ * squares_ - cells_.x * cells_.x - cells_.y * cells_.y;
        Similarity s;
        if (spread <= 0) return s;
        const std::int64_t along = std::int64_t{count_} * along_ - dot(cells_, offset_);
        const std::int64_t across = std::int64_t{count_} * across_ - cross(cells_, offset_);
        s.stretch_q20 = short_quotient(along << 8, spread);
        s.turn_q20 = short_quotient(across << 8, spread);
        const FixedVec rest = offset_ - change(s, {cells_.x * (1 << 12), cells_.y * (1 << 12)});
        s.shift_q12 = {rest.x / count_, rest.y / count_};
        return s;
    }

  private:
    std::int32_t count_ = 0;
    FixedVec cells_;
    FixedVec offset_;
    std::int32_t squares_ = 0;
    std::int32_t along_ = 0;
    std::int32_t across_ = 0;
};

/// Returns the cell map after a similarity transform of the cells about the cell `middle`.
CellMap changed(const CellMap& cells, FixedVec middle, const Similarity& s) {
    const FixedVec x = cells.along_x_q16;
    const FixedVec y = cells.along_y_q16;
    const FixedVec in_u = change(s, {y.x, x.x});
    const FixedVec in_v = change(s, {y.y, x.y});
    const FixedVec along_x = x + FixedVec{in_u.y, in_v.y};
    const FixedVec along_y = y + FixedVec{in_u.x, in_v.x};
    const auto shift_q16 = [&](std::int32_t of_x, std::int32_t of_y) {
        return ((of_x >> 8) * s.shift_q12.x + (of_y >> 8) * s.shift_q12.y) >> 4;
    };
    const CellMap around{{}, along_x, along_y};
    return {place_q16(cells, middle.x, middle.y) - place_q16(around, middle.x, middle.y) +
                FixedVec{shift_q16(x.x, y.x), shift_q16(x.y, y.y)},
            along_x, along_y};
}

/// Measures rings of dots, and fits a similarity transform to the dots that agree with the code.
class Rounds {
  public:
    Rounds(Tracking& tracking, FixedVec middle)
        : tracking_(tracking), before_(tracking.cells), middle_(middle) {}

    /// Shifts the cells by the mean offset of up to five dots, at the middle cell and its four
    /// neighbours. These dots need not agree with the code.
    void recentre();
    void measure(int i, int j);
    /// Applies the fitted similarity transform to the cells.
    void lay_cells() {
        similarity_ = fit_.solve();
        tracking_.cells = changed(before_, middle_, similarity_);
    }
    void lay_cells_as_before() { tracking_.cells = before_; }

    int seen() const { return seen_; }
    int agreeing() const { return fit_.count(); }
    const Similarity& similarity() const { return similarity_; }
    std::int32_t mean_mass() const { return masses_ / agreeing(); }
    std::int32_t mean_displacement_q12() const { return projections_q12_ / (2 * agreeing()); }

  private:
    Tracking& tracking_;
    CellMap before_;
    const FixedVec middle_;  ///< the middle cell
    SimilarityFit fit_;
    Similarity similarity_;
    int seen_ = 0;
    std::int32_t masses_ = 0;
    std::int32_t projections_q12_ = 0;
};

void Rounds::recentre() {
    FixedVec sum_q8;
    std::int32_t count = 0;
    for (const FixedVec step :
         {FixedVec{0, 0}, FixedVec{1, 0}, FixedVec{0, 1}, FixedVec{-1, 0}, FixedVec{0, -1}}) {
        const FixedVec cell = middle_ + step;
        NearDot dot;
        if (!measure_around(tracking_, place_q16(tracking_.cells, cell.x, cell.y), dot)) continue;
        const Symbol symbol = coded_symbol(tracking_, cell.x, cell.y);
        const FixedVec displaced_q16 = tracking_.displaced_q16[static_cast<std::size_t>(symbol)];
        sum_q8 = sum_q8 + dot.offset_q8 - FixedVec{displaced_q16.x >> 8, displaced_q16.y >> 8};
        ++count;
    }
    if (count == 0) return;
    before_.origin_q16 =
        before_.origin_q16 + FixedVec{sum_q8.x / count * 256, sum_q8.y / count * 256};
    tracking_.cells = before_;
}

void Rounds::measure(int i, int j) {
    const FixedVec at_q16 = place_q16(tracking_.cells, i, j);
    // Skips cells outside the first rows, such as most cells of the outer rings.
    if (!is_kept(tracking_, pixel_at(at_q16), kHalf_px)) return;
    NearDot dot;
    if (!measure_around(tracking_, at_q16, dot)) return;
    ++seen_;
    const Projections p = projections(tracking_, dot.offset_q8);
    const Symbol symbol = coded_symbol(tracking_, i, j);
    if (symbol_of(p) != symbol) return;
    const FixedVec cell = FixedVec{i, j} - middle_;
    const FixedVec offset_q12{(p.y_q12 - p.x_q12) / 2 - dx(symbol) * tracking_.displacement_q12,
                              (p.y_q12 + p.x_q12) / 2 - dy(symbol) * tracking_.displacement_q12};
    // The offset was measured relative to the cells as updated by the previous fit. Adding this
    // update gives the offset from the original cells.
    const FixedVec moved_q12 = change(similarity_, {cell.x * (1 << 12), cell.y * (1 << 12)});
    fit_.add(cell, offset_q12 + moved_q12 + similarity_.shift_q12);
    masses_ += dot.mass;
    projections_q12_ += magnitude(p.x_q12) + magnitude(p.y_q12);
}

/// Calls `use` for each cell of a ring around the middle cell, except cells that cannot be in view.
/// `round` is the distance of the ring from the middle cell, in cells.
template <typename Use>
void visit_round(const Tracking& tracking, FixedVec middle, int round, Use use) {
    const auto is_in = [&](int cell) {
        return cell >= tracking.first_cell && cell <= tracking.last_cell;
    };
    for (int j = middle.y - round; j <= middle.y + round; ++j) {
        if (!is_in(j)) continue;
        const bool is_end = round == 0 || magnitude(j - middle.y) == round;
        for (int i = middle.x - round; i <= middle.x + round; i += is_end ? 1 : 2 * round) {
            if (is_in(i)) use(i, j);
        }
    }
}

/// Updates the slopes of the plane (the inverse of the cell map) after a small change to the cells.
void turn_back(const Similarity& s, Tracking& tracking) {
    tracking.du_q20 = tracking.du_q20 - change(s, tracking.du_q20);
    tracking.dv_q20 = tracking.dv_q20 - change(s, tracking.dv_q20);
}

}  // namespace

bool find_turn(Tracking& tracking) {
    const FixedVec middle = middle_cell(tracking);
    Rounds rounds(tracking, middle);
    rounds.recentre();
    bool agree = true;
    for (int round = 0; round <= kRounds && agree; ++round) {
        const int before = rounds.agreeing();
        visit_round(tracking, middle, round, [&](int i, int j) { rounds.measure(i, j); });
        agree = rounds.seen() < kMinMeasured ||
                8 * rounds.agreeing() >= kMinFraction_q3 * rounds.seen();
        // Moves the cells only after rings 1, 2 and 4. Ring 0, the middle dot, was already used by
        // `recentre`. Ring 3 alone adds too few dots for another fit.
        const bool moves_cells = round % 2 == 0 ? round > 0 : round == 1;
        if (moves_cells && rounds.agreeing() > before) rounds.lay_cells();
    }
    if (!agree || rounds.agreeing() < kMinDots) {
        rounds.lay_cells_as_before();
        return false;
    }
    turn_back(rounds.similarity(), tracking);
    set_displacement(rounds.mean_displacement_q12(), tracking);
    tracking.min_mass = rounds.mean_mass() * 3 / 8;
    tracking.max_mass = rounds.mean_mass() * 5 / 2;
    return true;
}

}  // namespace dotpose::core
