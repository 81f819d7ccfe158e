/// Counts readings and wrong positions by their p_wrong.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "dotpose/options.hpp"

namespace dotpose::tables {

/// Options with which every reading is accepted, however doubtful.
inline constexpr IntegrityOptions kAcceptAll{0, 256};

/// The relation of a wrong position to the true one.
enum class Wrong : std::uint8_t {
    near,       ///< shares five or more lines in a row
    single,     ///< differs in the place of one secondary sequence
    far,        ///< differs in two or more, and shares some line
    section,    ///< the same position in another section
    unrelated,  ///< none of these, or another orientation
    none,
};
inline constexpr std::array kWrongs{Wrong::near, Wrong::single, Wrong::far, Wrong::section,
                                    Wrong::unrelated};
inline constexpr std::array kWrongNames{"near", "single", "far", "section", "unrelated"};

/// Readings with the same or a similar p_wrong.
struct Bin {
    std::uint64_t frames = 0;
    double claimed = 0;  ///< sum of p_wrong
    std::array<std::uint64_t, kWrongs.size()> wrong{};

    std::uint64_t all_wrong() const {
        return std::accumulate(wrong.begin(), wrong.end(), std::uint64_t{0});
    }
    Bin& operator+=(const Bin& other) {
        frames += other.frames;
        claimed += other.claimed;
        for (std::size_t w = 0; w < wrong.size(); ++w)
            wrong[w] += other.wrong[w];
        return *this;
    }
};

struct IntegrityTally {
    /// Bin n has the readings with p_wrong = 2^-n; the last bin has all smaller values as well.
    std::array<Bin, 64> bins;
    std::uint64_t unread = 0;
    std::uint64_t passed_over = 0;  ///< number of grids that were skipped as not doubtful

    void add(int p_wrong_log2, Wrong wrong) {
        Bin& bin = bins[std::min(static_cast<std::size_t>(-p_wrong_log2), bins.size() - 1)];
        ++bin.frames;
        bin.claimed += std::ldexp(1.0, p_wrong_log2);
        if (wrong != Wrong::none) ++bin.wrong[static_cast<std::size_t>(wrong)];
    }
    /// Returns the sum of the bins `first` to `last`; bins that do not exist are empty.
    Bin sum(std::size_t first, std::size_t last) const {
        Bin sum;
        for (std::size_t n = first; n <= last && n < bins.size(); ++n)
            sum += bins[n];
        return sum;
    }
    IntegrityTally& operator+=(const IntegrityTally& other) {
        unread += other.unread;
        passed_over += other.passed_over;
        for (std::size_t n = 0; n < bins.size(); ++n)
            bins[n] += other.bins[n];
        return *this;
    }
};

}  // namespace dotpose::tables
