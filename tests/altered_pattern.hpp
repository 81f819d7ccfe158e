/// Renders patterns in which some symbols differ from the code. Everything else is rendered as in
/// the simulator.
#pragma once

#include <cstdint>

#include "dotpose/tools/simulate.hpp"
#include "simulate/ink.hpp"

namespace dotpose::test {

inline Vec2 displacement_of(Symbol symbol) {
    return {static_cast<double>(dx(symbol)), static_cast<double>(dy(symbol))};
}

/// Returns a random number generator for a cell. Its sequence depends only on the seed and the
/// cell.
inline Rng rng_of(std::uint64_t seed, Cell cell) {
    return Rng(seed, (std::uint64_t{cell.x} << 32) | cell.y);
}

/// Returns the symbol of a cell, each of whose two bits is flipped with probability `probability`.
inline Symbol flipped_symbol(const Pattern& pattern, double probability, std::uint64_t seed,
                             Cell cell) {
    Rng rng = rng_of(seed, cell);
    const Symbol symbol = symbol_at(pattern.code, cell, pattern.section);
    const int flip_x = rng.uniform() < probability ? 1 : 0;
    const int flip_y = rng.uniform() < probability ? 1 : 0;
    return make_symbol(x_bit(symbol) ^ flip_x, y_bit(symbol) ^ flip_y);
}

/// Renders the shot like `render(shot)`, but displaces each dot by the result of `displacement_of`,
/// in units of the nominal displacement.
inline GreyImage render_dots(const Shot& shot, const simulate::DisplacementOf& displacement_of) {
    const Imperfections& seen = shot.imperfections;
    const simulate::View view(shot.camera, shot.pose, seen);
    Rng rng(shot.seed);
    simulate::Ink ink;
    simulate::add_dots(ink, view, shot.page, seen, displacement_of);
    simulate::add_graphics(ink, view, seen, rng);
    simulate::add_dirt(ink, view, shot.page.pattern.dot_mm, seen, rng);
    return simulate::read_out(simulate::expose(ink, view, shot.page, seen), shot.camera, seen, rng);
}

}  // namespace dotpose::test
