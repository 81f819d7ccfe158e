// What microcontrollers need of locating a frame: the checks of its arguments, and the classes that
// take rows. It uses nothing of the attempts of desktops, so scripts/export-device leaves those
// out.
#include <span>

#include "core/attempts/device.hpp"
#include "core/attempts/device_tracked.hpp"
#include "core/attempts/steps.hpp"
#include "core/device_workspace.hpp"
#include "core/locate.hpp"
#include "core/option_ranges.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::core {
namespace {

bool are_valid(const Options& options) {
    return all_options(options, [](const char*, std::int32_t value, std::int32_t low,
                                   std::int32_t high) { return value >= low && value <= high; });
}

}  // namespace

Status check(int width_px, int height_px, const Options& options, const Workspace& w) {
    if (!are_valid(options)) return Status::bad_argument;
    if (width_px < kMinFrameSide_px || height_px < kMinFrameSide_px) {
        return Status::image_too_small;
    }
    if (width_px > w.max_width_px || height_px > w.max_height_px) return Status::image_too_large;
    return Status::ok;
}

Status check(const ImageView& image, const Options& options, const Workspace& w) {
    const Status status = check(image.width_px, image.height_px, options, w);
    return status == Status::ok && image.pixels == nullptr ? Status::bad_argument : status;
}

const Fix& refuse(Status reason, Workspace& w) {
    forget_frame(w);
    w.fix.status = reason;
    return w.fix;
}

Fix locate_as_device(const ImageView& image, const Options& options, Workspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    detect_image(image, options, w);
    return finish_device_attempt(options, w);
}

Fix locate_as_device(const ImageView& image, const Options& options, const Prediction& prediction,
                     Workspace& w) {
    Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    status = begin_device_tracked(image.width_px, image.height_px, options, prediction, w);
    for (int v = 0; v < image.height_px && status == Status::ok; ++v)
        status = push_tracked_row(image.row(v), w);
    const bool is_tracked =
        status == Status::ok && finish_device_tracked(options, w).status == Status::ok;
    return is_tracked ? w.fix : locate_as_device(image, options, w);
}

Status begin(int width_px, int height_px, const Options& options, Workspace& w) {
    const Status status = check(width_px, height_px, options, w);
    if (status != Status::ok) return refuse(status, w).status;
    begin_frame(width_px, height_px, w);
    return Status::ok;
}

Status begin(int width_px, int height_px, const Options& options, const Prediction& prediction,
             Workspace& w) {
    const Status status = check(width_px, height_px, options, w);
    if (status != Status::ok) return refuse(status, w).status;
    return begin_device_tracked(width_px, height_px, options, prediction, w);
}

void push_row(const std::uint8_t* pixels, const Options& options, Workspace& w) {
    if (w.tracking.is_on) {
        static_cast<void>(push_tracked_row(pixels, w));
    } else {
        detect_row(pixels, options, w);
    }
}

const Fix& finish_as_device(const Options& options, Workspace& w) {
    return w.tracking.is_on ? finish_device_tracked(options, w) : finish_device_attempt(options, w);
}

}  // namespace dotpose::core

namespace dotpose {
namespace {

template <typename T>
std::span<const T> first(std::span<T> all, int count) {
    return all.first(static_cast<std::size_t>(count));
}

Trace trace_of(const core::Workspace& w, const Options& options) {
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

template <int Width, int Height>
DeviceMemoryFor<Width, Height>::DeviceMemoryFor() {
    workspace_ = core::make_workspace<core::DeviceWorkspaceFor<Width, Height>>(bytes_);
}
template class DeviceMemoryFor<160, 120>;
template class DeviceMemoryFor<188, 120>;
template class DeviceMemoryFor<320, 240>;

void RowLocator::set_options(const Options& options) {
    options_ = options;
    note_begin(Status::bad_argument, 0);
}

void RowLocator::note_begin(Status status, int height_px) {
    begun_ = status;
    rows_left_ = status == Status::ok ? height_px : 0;
}

Status RowLocator::begin(int width_px, int height_px) {
    note_begin(core::begin(width_px, height_px, options_, *workspace_), height_px);
    return begun_;
}

Status RowLocator::begin(int width_px, int height_px, const Prediction& prediction) {
    note_begin(core::begin(width_px, height_px, options_, prediction, *workspace_), height_px);
    return begun_;
}

void RowLocator::push_row(const std::uint8_t* pixels) {
    if (rows_left_ == 0) return;
    --rows_left_;
    core::push_row(pixels, options_, *workspace_);
}

bool RowLocator::has_rows() {
    if (begun_ != Status::ok) core::refuse(begun_, *workspace_);
    return begun_ == Status::ok;
}

Trace RowLocator::trace() const {
    return trace_of(*workspace_, options_);
}

Fix RowLocator::shown() {
    note_begin(Status::bad_argument, 0);
    workspace_->fix.spacing_nm = options_.spacing_nm;
    return workspace_->fix;
}

DeviceLocator::DeviceLocator(AnyDeviceMemory& memory, const Options& options)
    : RowLocator(memory.workspace_, options) {}

Fix DeviceLocator::locate(const ImageView& image) {
    core::locate_as_device(image, options_, *workspace_);
    return shown();
}

Fix DeviceLocator::locate(const ImageView& image, const Prediction& prediction) {
    core::locate_as_device(image, options_, prediction, *workspace_);
    return shown();
}

Fix DeviceLocator::finish() {
    if (has_rows()) core::finish_as_device(options_, *workspace_);
    return shown();
}

}  // namespace dotpose
