// Line sets: sets of lines that an alternative shares, and roll offsets of 16 lines at a time.
// likelihood_ratios.hpp defines the terms.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Set of lines. Bit i is line i.
using LineSet = std::uint64_t;
static_assert(kMaxLines <= 64);

/// For each sequence, a set of places.
using PlaceSets = std::array<PlaceBits, 4>;

/// Roll offsets of 16 lines.
using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
static_assert(kMaxLines % sizeof(Bytes) == 0);

inline Bytes bytes_at(const RollOffsets& offsets, std::size_t line) {
    Bytes bytes;
    std::memcpy(&bytes, offsets.data() + line, sizeof bytes);
    return bytes;
}

/// Reduces roll offsets modulo kSections. The arguments must be less than 2 * kSections.
inline Bytes modulo_sections(Bytes offsets) {
    return offsets - (static_cast<Bytes>(offsets >= kSections) & kSections);
}

/// The first two gaps between shared lines. A gap consists of adjacent lines that are not shared.
/// `before` and `after` are the shared lines directly before and after each gap. For a missing gap,
/// both are the first shared line.
struct Gaps {
    explicit Gaps(LineSet shared) {
        before = after = {std::countr_zero(shared), std::countr_zero(shared)};
        for (LineSet rest = shared; count < before.size(); ++count) {
            // The addition carries through the first run of shared lines, so `beyond` contains the
            // shared lines after this run.
            const LineSet beyond = rest & (rest + (rest & -rest));
            if (beyond == 0) break;
            before[count] = std::countr_zero(rest);
            after[count] = std::countr_zero(beyond);
            rest = beyond;
        }
    }
    std::size_t count = 0;
    std::array<int, 2> before;
    std::array<int, 2> after;
};

}  // namespace dotpose::core
