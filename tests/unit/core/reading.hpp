// Builds the grid that the decoder receives for an ideal view of the pattern.
#pragma once

#include <array>

#include "core/decode/likelihood.hpp"
#include "core/decode/window.hpp"
#include "core/math/plane.hpp"
#include "geometry.hpp"

namespace dotpose::core_test {

/// A view, its dots, and the matrices P read from the dots. The grid is rotated by the quarter turn
/// `turn`, and its cell (0, 0) is near the image centre.
struct Reading {
    Reading(const View& view_, QuarterTurn turn_, std::vector<DetectedDot> dots_, int side = 64)
        : view(view_), turn(turn_), dots(std::move(dots_)), owned(side) {
        zero = {static_cast<int>(std::lround(view.at_centre.x)) + 2,
                static_cast<int>(std::lround(view.at_centre.y)) - 1};
        plane = core::plane_from_lattice(lattice_of(view.mesh_turned(turn, zero)),
                                         fixed(view.centre_px(), 8));
        status = core::assign_likelihoods(dots, plane, owned.grid);
        if (status != Status::ok) return;
        decoding.window = core::choose_window(grid(), kWindowSide);
        decoding.region = core::choose_window(grid(), kMaxLines);
    }
    Reading(const View& view_, QuarterTurn turn_)
        : Reading(view_, turn_, dots_of(pattern_dots(view_))) {}

    const Grid& grid() const { return owned.grid; }
    /// Returns the true decoding of the grid, computed from geometry.
    Decoding truth() const {
        Decoding true_decoding = decoding;
        true_decoding.pattern_from_grid = turn;
        true_decoding.place = moved(view.code, view.place, zero.x, zero.y);
        return true_decoding;
    }

    View view;
    QuarterTurn turn;
    std::vector<DetectedDot> dots;
    OwnedGrid owned;
    FixedVec zero;  ///< pattern steps from `view.place` to cell (0, 0) of the grid
    PlaneFromImage plane;
    Status status;
    Decoding decoding;  ///< only the regions to decode are set
};

}  // namespace dotpose::core_test
