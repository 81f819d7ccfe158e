#include "core/lattice/origin.hpp"

#include "core/fixed.hpp"
#include "core/lattice/neighbours.hpp"

namespace dotpose::core {
namespace {

using Neighbours = std::span<const std::array<std::int16_t, 4>>;

/// Section II-B.2: (1) all four neighbours of the start are connected to it symmetrically, and
/// (2) exactly four other dots are connected to two of these sides.
bool is_intact(Neighbours neighbours, int start) {
    const auto& sides = neighbours[static_cast<std::size_t>(start)];
    for (const std::int16_t side : sides) {
        if (side < 0 || !counts(neighbours, side, start)) return false;
    }
    std::array<std::int16_t, 16> reached{};
    std::size_t reached_count = 0;
    int corners = 0;
    for (const std::int16_t side : sides) {
        for (const std::int16_t other : neighbours[static_cast<std::size_t>(side)]) {
            if (other < 0 || other == start || !counts(neighbours, other, side)) continue;
            if (std::find(sides.begin(), sides.end(), other) != sides.end()) continue;
            int times_before = 0;
            for (std::size_t i = 0; i < reached_count; ++i)
                times_before += reached[i] == other;
            reached[reached_count++] = other;
            corners += times_before == 1;
            if (times_before == 2) return false;
        }
    }
    return corners == 4;
}

}  // namespace

Status find_origin(std::span<const Dot> dots, std::span<const std::uint16_t> seeds,
                   Neighbours neighbours, Vec centre_q8, Lattice& lattice, int& origin_seed) {
    origin_seed = -1;
    std::int64_t nearest = INT64_MAX;
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        const std::int64_t distance = squared(dots[seeds[s]].centre_q8 - centre_q8);
        if (distance < nearest && is_intact(neighbours, static_cast<int>(s))) {
            nearest = distance;
            origin_seed = static_cast<int>(s);
        }
    }
    if (origin_seed < 0) return Status::no_intact_neighbourhood;
    // The mean of the start and its sides: five displaced dots, none of them more exact than
    // another.
    Vec sum = dots[seeds[static_cast<std::size_t>(origin_seed)]].centre_q8;
    for (const std::int16_t side : neighbours[static_cast<std::size_t>(origin_seed)]) {
        sum = sum + dots[seeds[static_cast<std::size_t>(side)]].centre_q8;
    }
    lattice.origin_q16 = {static_cast<std::int32_t>(std::int64_t{sum.x} * 256 / 5),
                          static_cast<std::int32_t>(std::int64_t{sum.y} * 256 / 5)};
    return Status::ok;
}

}  // namespace dotpose::core
