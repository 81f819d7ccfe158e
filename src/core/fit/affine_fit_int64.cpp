#include "core/fit/affine_fit_int64.hpp"

#include <bit>

#include "core/math/symmetric2.hpp"

namespace dotpose::core {
namespace {

/// Returns the sum of (a - mean a)(b - mean b) from the plain sums. Subtracts integers near the
/// means first, which keeps every product within 64 bits.
std::int64_t centred(std::int64_t sum_ab, std::int64_t sum_a, std::int64_t sum_b, std::int64_t n) {
    const std::int64_t a = sum_a / n;
    const std::int64_t b = sum_b / n;
    const std::int64_t about_ab = sum_ab - a * sum_b - b * (sum_a - n * a);
    return about_ab - divide_rounded((sum_a - n * a) * (sum_b - n * b), n);
}

/// Returns the left shift that brings the value into [2^29, 2^30). Negative shifts are to the
/// right.
int normalising_shift(std::int64_t value) {
    return value == 0 ? 0
                      : 30 - static_cast<int>(std::bit_width(static_cast<std::uint64_t>(value)));
}

std::int64_t shifted(std::int64_t value, int shift) {
    return shift >= 0 ? value * (std::int64_t{1} << shift) : value >> -shift;
}

}  // namespace

void AffineFitInt64::add(FixedVec source, FixedVec target) {
    const std::int64_t sx = source.x, sy = source.y, tx = target.x, ty = target.y;
    ++n_;
    sx_ += sx;
    sy_ += sy;
    tx_ += tx;
    ty_ += ty;
    sxsx_ += sx * sx;
    sxsy_ += sx * sy;
    sysy_ += sy * sy;
    sxtx_ += sx * tx;
    sxty_ += sx * ty;
    sytx_ += sy * tx;
    syty_ += sy * ty;
}

AffineFitInt64::Moments AffineFitInt64::source_moments() const {
    if (n_ == 0) return {};
    return {centred(sxsx_, sx_, sx_, n_), centred(sxsy_, sx_, sy_, n_),
            centred(sysy_, sy_, sy_, n_)};
}

FixedVec AffineFitInt64::source_mean() const {
    if (n_ == 0) return {};
    return {static_cast<std::int32_t>(divide_rounded(sx_, n_)),
            static_cast<std::int32_t>(divide_rounded(sy_, n_))};
}

bool AffineFitInt64::solve(int fraction_bits, AffineMap& map) const {
    if (n_ < 3) return false;
    const Moments m = source_moments();
    const int source_shift = normalising_shift(std::max(m.xx, m.yy));
    const Symmetric2<std::int64_t> spread{shifted(m.xx, source_shift), shifted(m.xy, source_shift),
                                          shifted(m.yy, source_shift)};
    const std::int64_t determinant = spread.determinant();
    // The points count as collinear if their spread across the line is at most a thousandth of
    // their spread along the line.
    if (determinant < std::int64_t{1} << 40) return false;

    const auto solve_one = [&](std::int64_t sx_t, std::int64_t sy_t, std::int32_t& dx,
                               std::int32_t& dy) {
        const int shift = normalising_shift(std::max(magnitude(sx_t), magnitude(sy_t)));
        const auto [x, y] = spread.solve_scaled(shifted(sx_t, shift), shifted(sy_t, shift));
        const int scale = fraction_bits + source_shift - shift;
        dx = scaled_quotient(x, determinant, scale);
        dy = scaled_quotient(y, determinant, scale);
    };
    solve_one(centred(sxtx_, sx_, tx_, n_), centred(sytx_, sy_, tx_, n_), map.dx.x, map.dy.x);
    solve_one(centred(sxty_, sx_, ty_, n_), centred(syty_, sy_, ty_, n_), map.dx.y, map.dy.y);
    const std::int64_t one = std::int64_t{1} << fraction_bits;
    map.offset_x = divide_rounded(tx_ * one - map.dx.x * sx_ - map.dy.x * sy_, n_);
    map.offset_y = divide_rounded(ty_ * one - map.dx.y * sx_ - map.dy.y * sy_, n_);
    return true;
}

}  // namespace dotpose::core
