// Row locator: the base class of Locator and DeviceLocator.
#include <span>

#include "core/steps.hpp"
#include "core/workspace.hpp"
#include "dotpose/locate.hpp"

namespace dotpose {
namespace {

template <typename T>
std::span<const T> first(std::span<T> all, int count) {
    return all.first(static_cast<std::size_t>(count));
}

Trace trace_of(const core::Workspace& w, const DeviceOptions& options) {
    const core::Grid& grid = w.grid;
    return {
        .options = options,
        .dots = w.found_dots(),
        .seeds = first(w.seeds, w.seed_count),
        .edges = first(w.edges, w.edge_count),
        .lattice = w.lattice,
        .grid_from_image = w.grid_from_image,
        .grid = {first(grid.storage, grid.columns * grid.rows),
                 {grid.i0, grid.j0, grid.columns, grid.rows}},
        .decoding = w.decoding,
        .pattern_from_image = w.pattern_from_image,
        .fix = w.fix,
    };
}

}  // namespace

void RowLocator::set_options(const DeviceOptions& options) {
    options_ = options;
    static_cast<void>(note_begin(Status::bad_argument, 0));
}

Status RowLocator::note_begin(Status status, int height_px) {
    begun_ = status;
    rows_left_ = status == Status::ok ? height_px : 0;
    return status;
}

bool RowLocator::takes_row() {
    if (rows_left_ == 0) return false;
    --rows_left_;
    return true;
}

bool RowLocator::has_rows() {
    if (begun_ != Status::ok) core::refuse(begun_, *workspace_);
    return begun_ == Status::ok;
}

Trace RowLocator::trace() const {
    return trace_of(*workspace_, options_);
}

Fix RowLocator::finished() {
    static_cast<void>(note_begin(Status::bad_argument, 0));
    workspace_->fix.spacing_nm = options_.spacing_nm;
    return workspace_->fix;
}

}  // namespace dotpose
