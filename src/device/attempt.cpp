#include "device/attempt.hpp"

#include <algorithm>

#include "core/decode/likelihood.hpp"
#include "core/decode/nominal.hpp"
#include "core/pose/subgrid.hpp"
#include "core/steps.hpp"
#include "device/affine_pose.hpp"
#include "device/grow.hpp"
#include "device/origin.hpp"

namespace dotpose::core {
namespace {

/// Maximum number of dots used to find the grid. This number bounds the search time
/// (docs/firmware.md).
constexpr int kSeeds = 64;

/// Returns the point at which the search for the grid starts. Usually, this is the image centre. If
/// the centroid of the dots is far from the image centre, for example because the edge of a sheet
/// is in view, the search starts at the centroid.
FixedVec start_q8(const Workspace& w) {
    const FixedVec centre_q8 = image_centre_q8(w.threshold);
    FixedVec sum_q4;
    for (const DetectedDot& dot : w.found_dots())
        sum_q4 = sum_q4 + FixedVec{dot.centre_q8.x >> 4, dot.centre_q8.y >> 4};
    const FixedVec mean_q8{sum_q4.x / w.dot_count * 16, sum_q4.y / w.dot_count * 16};
    // The centroid is far if its distance from the image centre along an axis exceeds 1/kFar of
    // half the image side. If the pattern fills the view, this distance is only a few hundredths of
    // half the side.
    constexpr int kFar = 4;
    const bool is_far = magnitude(mean_q8.x - centre_q8.x) * kFar > centre_q8.x ||
                        magnitude(mean_q8.y - centre_q8.y) * kFar > centre_q8.y;
    return is_far ? mean_q8 : centre_q8;
}

/// Finds the grid of the dots. Assumes that the camera looks straight at the paper. Errors:
/// no_grid, no_displacement.
Status find_grid(const DeviceOptions& options, Workspace& w) {
    const FixedVec start = start_q8(w);
    const Status status = find_axes(start, kSeeds, w);
    if (status != Status::ok) return status;
    find_origin(w.found_dots(), first(w.seeds, w.seed_count), start, w.lattice);
    const Status grown = grow_grid(w.found_dots(), options.lattice, start, w.lattice,
                                   w.grid_from_image);  // paper, section II-B.3
    // Later stages expect a map relative to the image centre.
    w.grid_from_image = affine_tangent(w.grid_from_image, image_centre_q8(w.threshold));
    return grown;
}

/// Minimum width and height of a grid, in cells, if sheets are known.
constexpr int kMinKnownSide = 3;

/// Reads the bits of the grid (paper, section II-B.4).
Status read_bits(Workspace& w) {
    return assign_affine_likelihoods(w.found_dots(), w.grid_from_image, w.grid,
                                     w.known.any() ? kMinKnownSide : kWindowSide);
}

/// Finds the place in the code. Searches the known sheets first and then, if other sheets are
/// possible, the whole code.
Status find_place(const DeviceOptions& options, DeviceWorkspace& w) {
    if (w.on_sheets != nullptr) {
        if (w.on_sheets->read(options, w)) return Status::ok;
        if (w.known.are_all() || w.in_whole_code == nullptr) return Status::not_certain;
        if (std::min(w.grid.columns, w.grid.rows) < kWindowSide) return Status::grid_too_small;
    }
    return w.in_whole_code->read(options, w);  // paper, sections II-B.5 to II-B.7
}

Status measure_pose(const DeviceOptions& options, Workspace& w) {
    const Nominal nominal(w.grid, options.code, w.decoding);
    w.pattern_from_image =
        upright_plane(w.grid_from_image, w.decoding.pattern_from_grid);  // paper, section II-B.8
    const Observations observations(w.found_dots(), w.grid, nominal);
    w.fix.dots_used = fit_affine_pose(observations, w.pattern_from_image, w.fix.displacement_q16);
    if (w.fix.dots_used == 0) return Status::no_grid;
    write_affine_pose(w.pattern_from_image, reference_q8(image_centre_q8(w.threshold), options),
                      options.code, w.decoding.place, w.fix);
    w.fix.attempt = Attempt::device;
    return Status::ok;
}

}  // namespace

const Fix& finish_device_attempt(const DeviceOptions& options, DeviceWorkspace& w) {
    // The trailing comments cite the sections of the paper.
    Status status = w.keeps_frame ? w.on_sheets->find_dots_of_small(options, w)
                                  : find_dots(options, w);        // section II-B.1
    if (status == Status::ok) status = find_grid(options, w);     // sections II-B.2 and II-B.3
    if (status == Status::ok) status = read_bits(w);              // section II-B.4
    if (status == Status::ok) status = find_place(options, w);    // sections II-B.5 to II-B.7
    if (status == Status::ok) status = measure_pose(options, w);  // section II-B.8
    w.fix.status = status;
    return w.fix;
}

}  // namespace dotpose::core
