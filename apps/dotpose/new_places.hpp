/// Selects calibration frames that show new places on a sheet. Further frames of a place that is
/// already covered add little information.
#pragma once

#include <cstddef>
#include <vector>

#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

namespace dotpose::cli {

class NewPlaces {
  public:
    /// Returns true and stores the place if the frame shows a new place. A place is new if it
    /// differs from every stored place in the same section in at least one of these properties:
    /// - the centre of the frame: by at least a quarter of the shorter frame side and at least two
    ///   spacings,
    /// - the direction: by at least 15 degrees, or
    /// - the distance from the paper: by at least 10 %.
    ///
    /// Each call to `thin_out` doubles these minimum differences. Returns false for a frame without
    /// a fix.
    bool take(const Fix& fix, ImageView image);

    std::size_t count() const { return places_.size(); }

    /// Removes every second stored place, and doubles the minimum differences for later frames.
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
    /// Factor by which the minimum differences have grown. Each call to `thin_out` doubles it.
    double factor_ = 1;
};

/// Removes the elements with odd indices.
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
