#include "new_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dotpose::cli {

bool NewPlaces::take(const Fix& fix, ImageView image) {
    if (fix.status != Status::ok) return false;
    constexpr double kShareOfView = 0.25;
    constexpr double kTurn_rad = 15 * std::numbers::pi / 180;
    constexpr double kScale = 0.1;
    // Minimum distance between the centres of two frames, in spacings. Frames whose centres are
    // closer show the same dots at almost the same pixels.
    constexpr double kMin_grid = 2;
    const Place here{fix.x_grid(), fix.y_grid(), fix.theta_rad(), fix.spacing_px(), fix.section};
    const double view_grid = std::min(image.width_px, image.height_px) / here.spacing_px;
    const double step_grid = factor_ * std::max(kMin_grid, kShareOfView * view_grid);
    const bool is_known = std::ranges::any_of(places_, [&](const Place& there) {
        const double distance = std::hypot(here.x_grid - there.x_grid, here.y_grid - there.y_grid);
        const double turn = std::remainder(here.theta_rad - there.theta_rad, 2 * std::numbers::pi);
        const double scale = here.spacing_px / there.spacing_px - 1;
        return here.section == there.section && distance < step_grid &&
               std::abs(turn) < factor_ * kTurn_rad && std::abs(scale) < factor_ * kScale;
    });
    if (!is_known) places_.push_back(here);
    return !is_known;
}

void NewPlaces::thin_out() {
    remove_every_second(places_);
    factor_ *= 2;
}

}  // namespace dotpose::cli
