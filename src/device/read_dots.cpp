#include "device/read_dots.hpp"

#include <algorithm>

#include "core/math/fixed.hpp"
#include "core/noinline.hpp"
#include "device/coded_cells.hpp"
#include "device/near_dot.hpp"
#include "device/predicted.hpp"

namespace dotpose::core {
namespace {

/// Direction in which a row of cells is read. In this direction, the image coordinate v does not
/// decrease. `step_q16` is the step from one cell to the next in the image, and `i_step` is the
/// corresponding change of the column index, 1 or -1.
struct RowDirection {
    FixedVec step_q16;
    int i_step;
};
RowDirection row_direction(const Tracking& tracking) {
    const FixedVec along = tracking.cells.along_x_q16;
    return along.y < 0 ? RowDirection{-along, -1} : RowDirection{along, 1};
}

TrackedView view_of(const Tracking& tracking) {
    // An intersection is in view if the whole square around its pixel is in the image.
    const int half_px = tracking.half_side_px;
    const std::int32_t min_q16 = half_px * 65536;
    const auto extent_q16 = [&](int side_px) {
        return static_cast<std::uint32_t>((side_px - 2 * half_px) * 65536);
    };
    return {{min_q16 + tracking.left_out_px * 65536, min_q16},
            extent_q16(tracking.width_px - 2 * tracking.left_out_px),
            extent_q16(tracking.height_px)};
}

/// Finds, in each row of cells, the first visible cell in the reading direction. Starts at row `j`,
/// continues in steps of `j_step`, and stops at a row without a visible cell. The visible cells of
/// a row are contiguous, and close to the visible cells of the previous row. The search in a row
/// therefore starts at the result for the previous row.
void lay_rows(Tracking& tracking, int j, int j_step) {
    const TrackedView view = tracking.view;
    const RowDirection direction = row_direction(tracking);
    const FixedVec along = tracking.cells.along_y_q16;
    const FixedVec to_next_q16 = j_step > 0 ? along : -along;
    const int max_first = (tracking.last_cell - tracking.first_cell) / 2;
    FixedVec at_q16 = place_q16(tracking.cells, kMiddleCell, j);
    int first = 0;  // first cell in view, in steps from the middle cell
    for (; j >= tracking.first_cell && j <= tracking.last_cell; j += j_step) {
        const FixedVec before_q16 = at_q16;
        const int before = first;
        for (; first < max_first && !view.has(at_q16); ++first)
            at_q16 = at_q16 + direction.step_q16;
        if (first == max_first) {
            first = before;
            at_q16 = before_q16;
        }
        for (; first > -max_first && !view.has(at_q16); --first)
            at_q16 = at_q16 - direction.step_q16;
        if (first == -max_first) return;
        for (; first > -max_first && view.has(at_q16 - direction.step_q16); --first)
            at_q16 = at_q16 - direction.step_q16;
        TrackedRow& row = tracking.grid_rows[static_cast<std::size_t>(j)];
        row.next_q16 = at_q16;
        row.i = kMiddleCell + direction.i_step * first;
        at_q16 = at_q16 + to_next_q16;
    }
}

/// Marks both bits of a cell as read, and marks the bits that disagree with the code as wrong.
/// Returns true if both bits agree with the code.
DOTPOSE_NOINLINE bool note(const Tracking& tracking, int i, int j, int symbol) {
    ComparedLine& column = column_of(tracking, i);
    ComparedLine& row = row_of(tracking, j);
    const auto in_column = std::uint32_t{1} << j;
    const auto in_row = std::uint32_t{1} << i;
    column.seen |= in_column;
    row.seen |= in_row;
    const int coded = (column.code >> j & 1) + (row.code >> i & 1) * 2;
    if (coded == symbol) return true;
    const int wrong = coded ^ symbol;
    if ((wrong & 1) != 0) column.wrong |= in_column;
    if ((wrong & 2) != 0) row.wrong |= in_row;
    return false;
}

/// Adds the next dot of a row to the sums. Skips the dot if it is too close to the border, if its
/// mass is implausible, or if its centre is far from the predicted centre. The symbol of the dot
/// must agree with the code. The sums cannot overflow: masses are below 2^12, offsets are at most 2
/// px (2^9 units of 2^-8 px), columns are at most 2^4 from the middle, and a row has at most 32
/// dots, so each sum over a row is at most 2^30.
DOTPOSE_NOINLINE void add_dot(Tracking& tracking, ReadSymbol read, TrackedRow& row) {
    const auto symbol = static_cast<std::size_t>(read.symbol());
    const FixedVec place_q16 = row.next_q16 + tracking.displaced_q16[symbol];
    const FixedVec pixel = pixel_at(place_q16);
    if (!is_kept(tracking, pixel, kDotHalf_px)) return;
    const std::uint8_t* const first =
        kept_row(tracking, pixel.y - kDotHalf_px) + pixel.x - kDotHalf_px;
    const DarkSums sums = dark_sums<kDotHalf_px>(first, tracking.stride_px, read.level());
    const std::int32_t mass = sums.mass;
    if (mass < tracking.min_mass || mass > tracking.max_mass) return;
    const auto in_pixel_q8 = [](std::int32_t a_q16) {
        return static_cast<std::int16_t>(a_q16) >> 8;
    };
    const FixedVec offset_q8{sums.x * 256 - mass * in_pixel_q8(place_q16.x),
                             sums.y * 256 - mass * in_pixel_q8(place_q16.y)};
    // Printers and lenses rarely displace a dot by more than an eighth of the spacing. Larger
    // offsets are due to dirt.
    if (!is_within(offset_q8, mass * (tracking.spacing_q8 >> 3))) return;
    ++tracking.dots_measured;
    FixedVec& of_symbol = tracking.offset_q8[symbol];
    of_symbol = of_symbol + offset_q8;
    const int i = row.i - kMiddleCell;
    row.mass += mass;
    row.mass_i += mass * i;
    row.mass_ii += mass * i * i;
    row.offset_q8 = row.offset_q8 + offset_q8;
    row.offset_i_q8 = row.offset_i_q8 + FixedVec{offset_q8.x * i, offset_q8.y * i};
}

}  // namespace

bool begin_reading(Tracking& tracking) {
    if (!lay_dot_pixels(tracking)) return false;
    std::fill(tracking.grid_rows.begin(), tracking.grid_rows.end(), TrackedRow{});
    tracking.view = view_of(tracking);
    lay_rows(tracking, kMiddleCell, -1);
    lay_rows(tracking, kMiddleCell + 1, 1);
    return true;
}

void read_ready_dots(Tracking& tracking) {
    const RowDirection direction = row_direction(tracking);
    // The pixels of a dot may extend one row below the square with half-width kHalf_px around its
    // intersection, so one more row must be stored. After the last row of the image, all visible
    // dots are ready.
    const bool is_last = tracking.rows_taken == tracking.height_px;
    const int ahead = is_last ? 0 : kHalf_px + 2;
    const std::int32_t ready_q16 = (tracking.rows_taken - ahead) * 65536 + 32767;
    TrackedRow* row = &tracking.grid_rows[static_cast<std::size_t>(tracking.first_cell)];
    for (int j = tracking.first_cell; j <= tracking.last_cell; ++j, ++row) {
        while (row->next_q16.y <= ready_q16) {
            const ReadSymbol read = read_symbol(tracking, row->next_q16);
            if (read.is_clear() && note(tracking, row->i, j, read.symbol()))
                add_dot(tracking, read, *row);
            const FixedVec next_q16 = row->next_q16 + direction.step_q16;
            row->next_q16.x = next_q16.x;
            row->next_q16.y = tracking.view.has(next_q16) ? next_q16.y : TrackedRow::kNever_q16;
            row->i += direction.i_step;
        }
    }
}

}  // namespace dotpose::core
