#include "locate/hypothesis.hpp"

#include <algorithm>
#include <cmath>

#include "code/rolls.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

struct Extent {
    int first = 0;
    int count = 0;
};

/// Returns the range of integers from `min` to `max`, rounded outwards, with a margin of 1 on each
/// side. Clamps the range to the `room` integers around 0.
Extent extent(float min, float max, int room) {
    const int half = room / 2;
    const int first = std::max(static_cast<int>(std::floor(std::max(min, -4096.0F))) - 1, -half);
    const int last =
        std::min(static_cast<int>(std::ceil(std::min(max, 4096.0F))) + 1, room - half - 1);
    return {first, std::max(last - first + 1, 0)};
}

/// Sets the minimum distance from the image border at which cells are listed.
void limit_to_image(const Frame& frame, const Hypothesis& hypothesis, CellsInView& view) {
    const float spacing = spacing_px(hypothesis.pattern_from_image);
    if (hypothesis.reads_cut_dots) {
        // Applies the margin to the intersections instead of the predicted dots. Otherwise, the
        // list would favour cells whose bits agree with the hypothesis.
        view.limits_intersections = true;
        view.margin_px = -tuning::confirm::kBeyondBorder * spacing;
        return;
    }
    // The margin excludes dots that touch the image border, because their images are incomplete.
    view.margin_px = margin_of_whole_dots_px(spacing);
    // In small views of known sheets, dots closer to the border are also needed.
    const auto shorter_px =
        static_cast<float>(std::min(frame.image.width_px, frame.image.height_px));
    if (frame.known.any() && shorter_px < tuning::known::kSmallView * spacing)
        view.margin_px = tuning::known::kMargin_px;
}

/// Writes the rolls of the lines in view into `memory`, and sets the pointers of the view to these
/// rolls.
void follow_code(CodeVariant code, const Place& place, const RollMemory& memory,
                 CellsInView& view) {
    const Place corner = moved(code, place, view.first_column, view.first_row);
    const auto follow = [&](std::uint32_t position, int section, std::uint32_t cross, int count,
                            std::span<std::uint8_t> rolls) {
        code::follow_rolls(code, position, section, cross,
                           rolls.first(static_cast<std::size_t>(count)));
    };
    follow(corner.cell.x, corner.section.u, corner.cell.y, view.columns, memory.columns);
    follow(corner.cell.y, corner.section.v, corner.cell.x, view.rows, memory.rows);
    view.column_rolls = memory.columns.data();
    view.row_rolls = memory.rows.data();
}

}  // namespace

float margin_of_whole_dots_px(float spacing_px) {
    return std::max(1.7F, 0.15F * spacing_px);
}

FloatLens float_lens(const FixedLens& lens) {
    constexpr float kQ40 = 1099511627776.0F;
    return {static_cast<float>(lens.k_q40) / kQ40, static_cast<float>(lens.centre_dx_q8) / 256,
            static_cast<float>(lens.centre_dy_q8) / 256};
}

CellsInView cells_in_view(const Frame& frame, const Hypothesis& hypothesis, float reach_px,
                          int max_cells, const RollMemory& rolls) {
    const ImageView& image = frame.image;
    const FloatVec centre = centre_px(image);
    CellsInView view;
    view.plane = hypothesis.pattern_from_image;
    view.lens = float_lens(frame.options.lens);
    view.lens.centre_x -= hypothesis.from_centre.x;
    view.lens.centre_y -= hypothesis.from_centre.y;
    view.centre_x = centre.x + hypothesis.from_centre.x;
    view.centre_y = centre.y + hypothesis.from_centre.y;
    view.width_px = static_cast<float>(image.width_px);
    view.height_px = static_cast<float>(image.height_px);
    view.reach_px = reach_px;
    view.displacement = hypothesis.displacement;
    limit_to_image(frame, hypothesis, view);
    const float half_width = std::min(centre.x + std::abs(hypothesis.from_centre.x) + 1, reach_px);
    const float half_height = std::min(centre.y + std::abs(hypothesis.from_centre.y) + 1, reach_px);
    float min_x = 0, min_y = 0, max_x = 0, max_y = 0;
    for (const FloatVec corner :
         {FloatVec{-half_width, -half_height}, FloatVec{half_width, -half_height},
          FloatVec{-half_width, half_height}, FloatVec{half_width, half_height}}) {
        const FloatVec at = plane_point(view.plane, corner);
        min_x = std::min(min_x, at.x);
        min_y = std::min(min_y, at.y);
        max_x = std::max(max_x, at.x);
        max_y = std::max(max_y, at.y);
    }
    const Extent columns = extent(min_x, max_x, static_cast<int>(rolls.columns.size()));
    const Extent rows = extent(min_y, max_y, static_cast<int>(rolls.rows.size()));
    view.first_column = columns.first;
    view.columns = columns.count;
    view.first_row = rows.first;
    view.rows = rows.count;
    const float spacing = spacing_px(view.plane);
    const float cells = 4 * half_width * half_height / (spacing * spacing);
    view.step = 1 + static_cast<int>(std::min(cells / static_cast<float>(max_cells), 65535.0F));
    follow_code(frame.options.code, hypothesis.place, rolls, view);
    return view;
}

void count_from_centre(CodeVariant code, Hypothesis& hypothesis) {
    FloatPlane& plane = hypothesis.pattern_from_image;
    const float column = std::floor(plane.at_x + 0.5F);
    const float row = std::floor(plane.at_y + 0.5F);
    plane.at_x -= column;
    plane.at_y -= row;
    hypothesis.place = moved(code, hypothesis.place, static_cast<std::int32_t>(column),
                             static_cast<std::int32_t>(row));
}

Similarity similarity_of(const DotOffsets& found) {
    // Closed-form least squares for offset = shift + (scale + i turn) * predicted point, in complex
    // numbers.
    const float fraction = 1 / static_cast<float>(found.points);
    const float u = found.u * fraction;  // mean predicted point
    const float v = found.v * fraction;
    const float spread = found.squares - static_cast<float>(found.points) * (u * u + v * v);
    Similarity fit{{found.off_u * fraction, found.off_v * fraction}, 0, 0, 0};
    const float squares_of_shift = found.off_u * fit.shift_px.x + found.off_v * fit.shift_px.y;
    float explained = 0;
    if (spread > 0) {
        const float along = found.along - found.off_u * u - found.off_v * v;
        const float across = found.across - found.off_v * u + found.off_u * v;
        fit.scale = along / spread;
        fit.turn_rad = across / spread;
        explained = fit.scale * along + fit.turn_rad * across;
        fit.shift_px.x -= fit.scale * u - fit.turn_rad * v;
        fit.shift_px.y -= fit.scale * v + fit.turn_rad * u;
    }
    fit.squares_px2 = std::max(found.squared - explained - squares_of_shift, 0.0F);
    return fit;
}

FloatPlane moved(const FloatPlane& plane, const Similarity& by) {
    FloatPlane p = recentred(plane, {-by.shift_px.x, -by.shift_px.y});
    const float du_x = p.du_x - p.du_x * by.scale - p.dv_x * by.turn_rad;
    const float du_y = p.du_y - p.du_y * by.scale - p.dv_y * by.turn_rad;
    p.dv_x += p.du_x * by.turn_rad - p.dv_x * by.scale;
    p.dv_y += p.du_y * by.turn_rad - p.dv_y * by.scale;
    p.du_x = du_x;
    p.du_y = du_y;
    return p;
}

}  // namespace dotpose::core
