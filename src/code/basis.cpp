#include "code/basis.hpp"

namespace dotpose::code {
namespace {

/// Returns the inverse of `a` modulo the prime `m`.
consteval std::uint32_t inverse(std::uint32_t a, std::uint32_t m) {
    std::uint32_t x = 1;
    while (a % m * x % m != 1)
        ++x;
    return x;
}

}  // namespace

// Computes a position from its places in the four sequences, with Garner's algorithm for the
// Chinese remainder theorem. All intermediate values fit in 32 bits.
std::uint32_t position_at(const Basis& basis, const std::array<std::uint32_t, 4>& places) {
    constexpr std::uint32_t kM1 = 236, kM2 = 233, kM3 = 31, kM4 = 241;
    static_assert(kM1 * kM2 * kM3 * kM4 == kPositionsPerAxis);
    // Returns digit n of the position in a mixed-radix system. The radices are the lengths of the
    // sequences. `so_far` is the number formed by the lower digits. `inverse` is the inverse of the
    // weight of digit n, modulo the length of sequence n.
    const auto digit = [&](std::size_t n, std::uint32_t so_far, std::uint32_t inverse) {
        const Secondary& a = basis[n];
        return a.place_of((places[n] + a.length - a.place_of(so_far)) * inverse);
    };
    const std::uint32_t p2 = places[0] + kM1 * digit(1, places[0], inverse(kM1, kM2));
    const std::uint32_t p3 = p2 + kM1 * kM2 * digit(2, p2, inverse(kM1 * kM2, kM3));
    return p3 + kM1 * kM2 * kM3 * digit(3, p3, inverse(kM1 * kM2 * kM3, kM4));
}

}  // namespace dotpose::code
