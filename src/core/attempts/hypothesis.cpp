#include "core/attempts/hypothesis.hpp"

#include <algorithm>
#include <cmath>

#include "code/rolls.hpp"

namespace dotpose::core {
namespace {

struct Extent {
    int first = 0;
    int count = 0;
};

/// Returns the whole numbers from `least` to `most`: at most `room` of them, those around 0.
Extent extent(float least, float most, int room) {
    const int half = room / 2;
    const int first = std::max(static_cast<int>(std::floor(std::max(least, -4096.0F))) - 1, -half);
    const int last =
        std::min(static_cast<int>(std::ceil(std::min(most, 4096.0F))) + 1, room - half - 1);
    return {first, std::max(last - first + 1, 0)};
}

/// Fills the workspace's rolls with those of the code along the lines of a view, which gets them.
void follow_code(Profile profile, const Place& place, CellsInView& view, Workspace& w) {
    const Place corner = moved(profile, place, view.first_column, view.first_row);
    const auto follow = [&](std::uint32_t position, int section, std::uint32_t cross, int count,
                            std::span<std::uint8_t> rolls) {
        code::follow_rolls(profile, position, code::roll_from(profile, position, section, cross),
                           rolls.first(static_cast<std::size_t>(count)));
    };
    follow(corner.cell.x, corner.section.u, corner.cell.y, view.columns, w.column_rolls);
    follow(corner.cell.y, corner.section.v, corner.cell.x, view.rows, w.row_rolls);
    view.column_rolls = w.column_rolls.data();
    view.row_rolls = w.row_rolls.data();
}

}  // namespace

FloatVec centre_px(const ImageView& image) {
    return {static_cast<float>(image.width_px - 1) / 2,
            static_cast<float>(image.height_px - 1) / 2};
}

FloatLens float_lens(const Lens& lens) {
    constexpr float kQ40 = 1099511627776.0F;
    return {static_cast<float>(lens.k_q40) / kQ40, static_cast<float>(lens.centre_dx_q8) / 256,
            static_cast<float>(lens.centre_dy_q8) / 256};
}

CellsInView cells_in_view(const ImageView& image, const Options& options,
                          const Hypothesis& hypothesis, float reach_px, int most_cells,
                          Workspace& w) {
    const FloatVec centre = centre_px(image);
    CellsInView view;
    view.plane = hypothesis.pattern_from_image;
    view.lens = float_lens(options.lens);
    view.lens.centre_x -= hypothesis.from_centre.x;
    view.lens.centre_y -= hypothesis.from_centre.y;
    view.centre_x = centre.x + hypothesis.from_centre.x;
    view.centre_y = centre.y + hypothesis.from_centre.y;
    view.width_px = static_cast<float>(image.width_px);
    view.height_px = static_cast<float>(image.height_px);
    view.reach_px = reach_px;
    view.displacement = hypothesis.displacement;
    // A dot that touches the border of the image is not seen completely.
    view.margin_px = std::max(1.7F, 0.15F * spacing_px(hypothesis.pattern_from_image));
    const float half_width = std::min(centre.x + std::abs(hypothesis.from_centre.x) + 1, reach_px);
    const float half_height = std::min(centre.y + std::abs(hypothesis.from_centre.y) + 1, reach_px);
    float least_x = 0, least_y = 0, most_x = 0, most_y = 0;
    for (const FloatVec corner :
         {FloatVec{-half_width, -half_height}, FloatVec{half_width, -half_height},
          FloatVec{-half_width, half_height}, FloatVec{half_width, half_height}}) {
        const FloatVec at = plane_point(view.plane, corner);
        least_x = std::min(least_x, at.x);
        least_y = std::min(least_y, at.y);
        most_x = std::max(most_x, at.x);
        most_y = std::max(most_y, at.y);
    }
    const Extent columns = extent(least_x, most_x, static_cast<int>(w.column_rolls.size()));
    const Extent rows = extent(least_y, most_y, static_cast<int>(w.row_rolls.size()));
    view.first_column = columns.first;
    view.columns = columns.count;
    view.first_row = rows.first;
    view.rows = rows.count;
    const float spacing = spacing_px(view.plane);
    const float cells = 4 * half_width * half_height / (spacing * spacing);
    view.step = 1 + static_cast<int>(std::min(cells / static_cast<float>(most_cells), 65535.0F));
    follow_code(options.profile, hypothesis.place, view, w);
    return view;
}

void count_from_centre(Profile profile, Hypothesis& hypothesis) {
    FloatPlane& plane = hypothesis.pattern_from_image;
    const float column = std::floor(plane.at_x + 0.5F);
    const float row = std::floor(plane.at_y + 0.5F);
    plane.at_x -= column;
    plane.at_y -= row;
    hypothesis.place = moved(profile, hypothesis.place, static_cast<std::int32_t>(column),
                             static_cast<std::int32_t>(row));
}

}  // namespace dotpose::core
