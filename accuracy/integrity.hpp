/// Counts of readings and wrong positions, grouped by p_wrong, for the `integrity` table.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "dotpose/device_options.hpp"

namespace dotpose::tables {

/// Options that accept readings with any p_wrong.
inline constexpr IntegrityOptions kAcceptAll{0, 256};

/// Counts for the readings in one bin of p_wrong.
struct Bin {
    std::uint64_t frames = 0;
    std::uint64_t wrong = 0;
    double predicted = 0;  ///< expected number of wrong positions: the sum of p_wrong

    Bin& operator+=(const Bin& other) {
        frames += other.frames;
        wrong += other.wrong;
        predicted += other.predicted;
        return *this;
    }
};

struct IntegrityTally {
    /// Bin n counts the readings with p_wrong near 2^-n. The last bin also counts all readings with
    /// a smaller p_wrong.
    std::array<Bin, 64> bins;
    std::uint64_t unread = 0;
    std::uint64_t skipped = 0;  ///< number of grids skipped because they are not doubtful

    void add(int p_wrong_log2, bool is_wrong) {
        Bin& bin = bins[std::min(static_cast<std::size_t>(-p_wrong_log2), bins.size() - 1)];
        ++bin.frames;
        bin.predicted += std::ldexp(1.0, p_wrong_log2);
        bin.wrong += is_wrong ? 1 : 0;
    }
    /// Returns the sum of the bins `first` to `last`, inclusive. `last` may exceed the index of the
    /// last bin.
    Bin sum(std::size_t first, std::size_t last) const {
        Bin sum;
        for (std::size_t n = first; n <= last && n < bins.size(); ++n)
            sum += bins[n];
        return sum;
    }
    IntegrityTally& operator+=(const IntegrityTally& other) {
        unread += other.unread;
        skipped += other.skipped;
        for (std::size_t n = 0; n < bins.size(); ++n)
            bins[n] += other.bins[n];
        return *this;
    }
};

enum class GridKind : std::uint8_t {
    any,
    doubtful,  ///< grids with so many errors that p_wrong is between 1e-3 and 1e-5
};

/// Generates grid `index` of a run, with random bit errors, decodes it, and adds the result to
/// `tally`. Thread-safe.
void try_grid(GridKind kind, std::uint64_t seed, std::uint64_t index, IntegrityTally& tally);

}  // namespace dotpose::tables
