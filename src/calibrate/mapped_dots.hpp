// The dots of a fix, with their offsets in a print map.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calibrate/located_frame.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::calibrate {

/// A dot that `locate` read, and its offset in the map, in spacings.
struct MappedDot {
    LocatedDot dot;
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

/// Dots of a fix that have an offset in the map. There are enough dots for a fit only if `use` is
/// MapUse::used.
struct MappedDots {
    MapUse use = MapUse::no_map;
    const MapPage* page = nullptr;  ///< the mapped page that contains the fix
    double noise = 0;               ///< MapPage::noise
    std::vector<MappedDot> dots;
};

MappedDots mapped_dots(const Fix& fix, const PrintMap& map, const Trace& trace);

/// Adds the covariance of the map error at the position of a fix to the covariance of the fix.
void add_map_error(const MapPage& page, Fix& fix);

/// Returns true if the map belongs to this print. Compares the variances of the residuals with and
/// without the map. `noise` is `MapPage::noise`, in the same unit as the residuals.
bool is_same_print(double variance_with_map, double variance_without, double noise);

}  // namespace dotpose::calibrate
