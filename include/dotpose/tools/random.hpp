/// Random numbers that are the same on every machine. The distributions of `<random>` are not
/// suitable, because their results depend on the standard library. For simulation, not for
/// cryptography.
#pragma once

#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Scrambles 64 bits: every input bit affects every output bit. This is the finalizer of splitmix64
/// (Steele, Lea, Flood, OOPSLA 2014).
constexpr std::uint64_t scramble(std::uint64_t bits) noexcept {
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
    return bits ^ (bits >> 31);
}

/// The splitmix64 generator. Seeding is fast, so every frame and every printed dot can have its own
/// generator.
class Rng {
  public:
    /// Seeds the generator.
    explicit constexpr Rng(std::uint64_t seed) noexcept : state_(seed) {}

    /// Starts an independent sequence for item `index` of a run.
    constexpr Rng(std::uint64_t seed, std::uint64_t index) noexcept
        : state_(scramble(scramble(seed + kStep) + kStep * (index + 1))) {}

    /// Returns 64 random bits.
    constexpr std::uint64_t bits() noexcept {
        state_ += kStep;
        return scramble(state_);
    }

    /// Returns a uniformly distributed number in [0, 1), a multiple of 2^-53.
    constexpr double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    /// Returns a uniformly distributed number in [low, high), or `low` if the limits are equal.
    constexpr double uniform(double low, double high) noexcept {
        return low + (high - low) * uniform();
    }

    /// Returns a uniformly distributed integer in [0, limit), where 0 < limit < 2^32. The bias is
    /// below limit / 2^64.
    constexpr std::uint32_t below(std::uint32_t limit) noexcept {
        const std::uint64_t high = bits() >> 32;
        const std::uint64_t low = bits() >> 32;
        return static_cast<std::uint32_t>((high * limit + ((low * limit) >> 32)) >> 32);
    }

    /// Returns a normally distributed number with mean 0 and standard deviation 1: the number of
    /// ones among 128 random bits plus a uniform random number, shifted and scaled. The excess
    /// kurtosis is -0.016, and the absolute value is at most 11.4. Avoids logarithms, because their
    /// last digits differ between machines.
    constexpr double normal() noexcept {
        constexpr double kInverseDeviation = 0.1765469659009499;  // 1 / sqrt(128 / 4 + 1 / 12)
        const int ones = ones_in(bits(), bits());
        return (ones - 64 + uniform() - 0.5) * kInverseDeviation;
    }

  private:
    /// Returns the number of set bits among 128 bits. Does not use std::popcount, which is compiled
    /// to a slow function call if the target processor may lack the instruction.
    static constexpr int ones_in(std::uint64_t a, std::uint64_t b) noexcept {
        constexpr std::uint64_t kOdd2 = 0x3333333333333333u;
        constexpr std::uint64_t kOdd4 = 0x0F0F0F0F0F0F0F0Fu;
        const auto in_fours = [](std::uint64_t x) {
            x -= (x >> 1) & 0x5555555555555555u;
            return (x & kOdd2) + ((x >> 2) & kOdd2);
        };
        const std::uint64_t fours = in_fours(a) + in_fours(b);  // each 4-bit field is at most 8
        const std::uint64_t eights = (fours & kOdd4) + ((fours >> 4) & kOdd4);
        return static_cast<int>((eights * 0x0101010101010101u) >> 56);
    }

    static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15u;
    std::uint64_t state_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
