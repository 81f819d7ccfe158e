/// Selects frames that show a new place of a sheet. Calibration gains little from others.
#pragma once

#include <cstddef>
#include <vector>

#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

namespace dotpose::cli {

class NewPlaces {
  public:
    /// Whether a frame differs from all that were taken before: its centre by a quarter of the
    /// shorter side of the frame, its direction by 15 degrees, or its distance from the paper by
    /// 10 %. If so, it is taken. A frame without a fix is none of these.
    bool take(const Fix& fix, ImageView image);

    std::size_t count() const { return places_.size(); }

    /// Forgets every second place, and takes only places that are twice as far apart from now on.
    void thin_out();

  private:
    struct Place {
        double x_grid = 0;
        double y_grid = 0;
        double theta_rad = 0;
        double spacing_px = 0;
        Section section;
    };

    std::vector<Place> places_;
    double far_ = 1;  ///< factor of all the differences
};

/// Removes every second element: those with odd indices.
template <typename T>
void remove_every_second(std::vector<T>& all) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < all.size(); i += 2) {
        if (i != kept) all[kept] = std::move(all[i]);
        ++kept;
    }
    all.resize(kept);
}

}  // namespace dotpose::cli
