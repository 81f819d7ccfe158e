// 64-bit division, which is the only libgcc function that the core calls. Debian's libgcc cannot be
// used, because it is compiled as plain MIPS32 code, and the short call instructions of microMIPS
// cannot switch to plain MIPS32.
#include <algorithm>
#include <bit>
#include <cstdint>

namespace {

std::uint64_t magnitude(std::int64_t n) {
    const auto bits = static_cast<std::uint64_t>(n);
    return n < 0 ? 0 - bits : bits;
}

}  // namespace

extern "C" std::int64_t __divdi3(std::int64_t n, std::int64_t d) {
    std::uint64_t rest = magnitude(n);
    std::uint64_t divisor = magnitude(d);
    int bit = std::countl_zero(divisor | 1) - std::countl_zero(rest | 1);
    divisor <<= std::max(bit, 0);
    std::uint64_t quotient = 0;
    for (; bit >= 0; --bit) {
        quotient *= 2;
        if (rest >= divisor) {
            rest -= divisor;
            ++quotient;
        }
        divisor /= 2;
    }
    return static_cast<std::int64_t>((n < 0) != (d < 0) ? 0 - quotient : quotient);
}
