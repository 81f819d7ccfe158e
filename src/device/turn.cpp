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
/// At least kMinDots dots must agree with the code, and at least the fraction kMinFraction_q3 / 8
/// of the measured dots.
constexpr int kMinDots = 12;
constexpr int kMinFraction_q3 = 6;
/// Minimum number of measured dots at which the fraction is tested.
constexpr int kMinMeasured = 8;

/// Least-squares fit of a shift, a rotation and a stretch: offset = shift + stretch p + turn J p,
/// where J is a rotation by 90 degrees and p is the place of a dot relative to the middle.
class SimilarityFit {
  public:
    /// Adds a dot. p is the predicted place of the dot, in px relative to the middle.
    void add(FixedVec p, FixedVec offset_q8) {
        ++count_;
        p_ = p_ + p;
        offset_ = offset_ + offset_q8;
        squares_ += p.x * p.x + p.y * p.y;
        along_ += p.x * offset_q8.x + p.y * offset_q8.y;
        across_ += p.x * offset_q8.y - p.y * offset_q8.x;
    }
    int count() const { return count_; }

    struct Similarity {
        std::int32_t stretch_q20 = 0;
        std::int32_t turn_q20 = 0;
        FixedVec shift_q8;  ///< shift at the middle
    };
    Similarity solve() const {
        const std::int64_t spread = std::int64_t{count_} * squares_ - squared(p_);
        Similarity s;
        if (spread <= 0) return s;
        const std::int64_t along = std::int64_t{count_} * along_ - dot(p_, offset_);
        const std::int64_t across = std::int64_t{count_} * across_ - cross(p_, offset_);
        s.stretch_q20 = short_quotient(along << 12, spread);
        s.turn_q20 = short_quotient(across << 12, spread);
        s.shift_q8 = {(offset_.x - ((s.stretch_q20 * p_.x - s.turn_q20 * p_.y) >> 12)) / count_,
                      (offset_.y - ((s.stretch_q20 * p_.y + s.turn_q20 * p_.x) >> 12)) / count_};
        return s;
    }

  private:
    std::int32_t count_ = 0;
    FixedVec p_;
    FixedVec offset_;
    std::int32_t squares_ = 0;
    std::int32_t along_ = 0;
    std::int32_t across_ = 0;
};

/// Returns the change of v under a similarity transform. Not inlined, because 64-bit products need
/// a lot of code.
[[gnu::noinline]] FixedVec change(const SimilarityFit::Similarity& s, FixedVec v) {
    const auto part = [](std::int64_t a_q20) { return static_cast<std::int32_t>(a_q20 >> 20); };
    return {part(std::int64_t{s.stretch_q20} * v.x - std::int64_t{s.turn_q20} * v.y),
            part(std::int64_t{s.stretch_q20} * v.y + std::int64_t{s.turn_q20} * v.x)};
}

CellMap changed(const CellMap& cells, FixedVec middle_q16, const SimilarityFit::Similarity& s) {
    return {cells.origin_q16 + change(s, cells.origin_q16 - middle_q16) +
                FixedVec{s.shift_q8.x * 256, s.shift_q8.y * 256},
            cells.along_x_q16 + change(s, cells.along_x_q16),
            cells.along_y_q16 + change(s, cells.along_y_q16)};
}

/// Measures rings of dots, and fits a similarity to the dots that agree with the code.
class Rounds {
  public:
    Rounds(Tracking& tracking, FixedVec middle_q16)
        : tracking_(tracking), before_(tracking.cells), middle_q16_(middle_q16) {}

    /// Shifts the cells by the mean offset of up to five dots, at the middle cell and its four
    /// neighbours. These dots need not agree with the code.
    void recentre(FixedVec middle);
    void measure(int i, int j);
    /// Moves the cells to the fitted place.
    void lay_cells() {
        similarity_ = fit_.solve();
        tracking_.cells = changed(before_, middle_q16_, similarity_);
    }
    void lay_cells_as_before() { tracking_.cells = before_; }

    int seen() const { return seen_; }
    int agreeing() const { return fit_.count(); }
    const SimilarityFit::Similarity& similarity() const { return similarity_; }
    std::int32_t mean_mass() const { return masses_ / agreeing(); }
    std::int32_t mean_displacement_q12() const { return projections_q12_ / (2 * agreeing()); }

  private:
    Tracking& tracking_;
    CellMap before_;
    const FixedVec middle_q16_;
    SimilarityFit fit_;
    SimilarityFit::Similarity similarity_;
    int seen_ = 0;
    std::int32_t masses_ = 0;
    std::int32_t projections_q12_ = 0;
};

void Rounds::recentre(FixedVec middle) {
    FixedVec sum_q8;
    std::int32_t count = 0;
    for (const FixedVec step :
         {FixedVec{0, 0}, FixedVec{1, 0}, FixedVec{0, 1}, FixedVec{-1, 0}, FixedVec{0, -1}}) {
        const FixedVec cell = middle + step;
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
    const FixedVec displaced_q16 = tracking_.displaced_q16[static_cast<std::size_t>(symbol)];
    const FixedVec was_q16 = place_q16(before_, i, j);
    const FixedVec p_q16 = was_q16 - middle_q16_;
    const FixedVec moved_q16 = at_q16 - was_q16 - displaced_q16;
    fit_.add({p_q16.x >> 16, p_q16.y >> 16},
             dot.offset_q8 + FixedVec{moved_q16.x >> 8, moved_q16.y >> 8});
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

/// Updates the slopes du and dv of the plane, which is the inverse of the cell map, after the cells
/// were stretched by s and rotated by t. Both are small, so to first order du changes by -(s du + t
/// dv), and dv by -(s dv - t du).
void turn_back(const SimilarityFit::Similarity& s, Tracking& tracking) {
    FixedVec& du = tracking.du_q20;
    FixedVec& dv = tracking.dv_q20;
    const FixedVec of_x = change(s, {dv.x, du.x});
    const FixedVec of_y = change(s, {dv.y, du.y});
    du = du - FixedVec{of_x.y, of_y.y};
    dv = dv - FixedVec{of_x.x, of_y.x};
}

}  // namespace

bool find_turn(Tracking& tracking) {
    const FixedVec middle_q16{(tracking.width_px - 1) * 32768, (tracking.first_rows - 1) * 32768};
    const FixedVec middle = middle_cell(tracking);
    Rounds rounds(tracking, middle_q16);
    rounds.recentre(middle);
    bool agree = true;
    for (int round = 0; round <= kRounds && agree; ++round) {
        const int before = rounds.agreeing();
        visit_round(tracking, middle, round, [&](int i, int j) { rounds.measure(i, j); });
        agree = rounds.seen() < kMinMeasured ||
                8 * rounds.agreeing() >= kMinFraction_q3 * rounds.seen();
        // Moves the cells only after rings 1, 2 and 4. `recentre` has already used ring 0, the
        // middle dot, and ring 3 adds few dots to ring 2.
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
