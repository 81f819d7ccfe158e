#include "device/affine_fit_int32.hpp"

#include <bit>

#include "core/math/symmetric2.hpp"

namespace dotpose::core {
namespace {

/// Returns the number of bits by which `value` must be shifted right to fit in `bits` bits, or 0 if
/// it already fits. `value` must not be negative.
int excess_bits(std::int64_t value, int bits) {
    return std::max(static_cast<int>(std::bit_width(static_cast<std::uint64_t>(value))) - bits, 0);
}

/// Returns n / d. Uses a 32-bit division if n fits in 32 bits, because a 64-bit division takes five
/// times as long on small processors.
std::int64_t quotient(std::int64_t n, std::int32_t d) {
    const auto small = static_cast<std::int32_t>(n);
    return small == n ? small / d : n / d;
}

}  // namespace

[[gnu::noinline]] void AffineFitInt32::carry_over() {
    all_.xx += recent_.xx;
    all_.xy += recent_.xy;
    all_.yy += recent_.yy;
    all_.ix += recent_.ix;
    all_.iy += recent_.iy;
    all_.jx += recent_.jx;
    all_.jy += recent_.jy;
    recent_ = {};
}

[[gnu::noinline]] std::int64_t AffineFitInt32::moment(std::int64_t products, std::int32_t a,
                                                      std::int32_t b) const {
    return count() * products - std::int64_t{a} * b;
}

bool AffineFitInt32::solve(int bits, PlaneFromImage& plane) {
    carry_over();
    if (count() < 3) return false;
    const std::int64_t mxx = moment(all_.xx, p_.x, p_.x);
    const std::int64_t myy = moment(all_.yy, p_.y, p_.y);
    const int shift = excess_bits(std::max(mxx, myy), 30);
    const Symmetric2<std::int64_t> spread{mxx >> shift, moment(all_.xy, p_.x, p_.y) >> shift,
                                          myy >> shift};
    const std::int64_t determinant = spread.determinant();
    const std::int64_t trace = spread.xx + spread.yy;
    // The points are considered collinear if their standard deviation across the best-fitting line
    // is less than about 1/32 of their standard deviation along it.
    if (determinant <= 0 || determinant >> 8 < trace * trace >> 18) return false;

    const auto solve_one = [&](std::int32_t sum, std::int64_t of_x, std::int64_t of_y,
                               std::int32_t& du_q24, std::int32_t& dv_q24) {
        const std::int64_t mx = moment(of_x, sum, p_.x);
        const std::int64_t my = moment(of_y, sum, p_.y);
        const int own = excess_bits(std::max(magnitude(mx), magnitude(my)), 29);
        const auto [x, y] = spread.solve_scaled(mx >> own, my >> own);
        const int scale = 24 + 3 + own - shift - bits;
        du_q24 = scaled_quotient(x, determinant, scale);
        dv_q24 = scaled_quotient(y, determinant, scale);
        const std::int64_t slope = std::int64_t{du_q24} * p_.x + std::int64_t{dv_q24} * p_.y;
        return static_cast<std::int32_t>(
            quotient((sum * 65536LL >> bits) - (slope >> 11), count()));
    };
    plane.at_centre_q16.x = solve_one(target_.x, all_.ix, all_.iy, plane.du_q24.x, plane.dv_q24.x);
    plane.at_centre_q16.y = solve_one(target_.y, all_.jx, all_.jy, plane.du_q24.y, plane.dv_q24.y);
    return true;
}

}  // namespace dotpose::core
