// The objects that callers hold: memory, and options that stay the same through a frame.
#include <array>
#include <cstddef>
#include <new>
#include <span>
#include <type_traits>

#include "core/locate.hpp"
#include "dotpose/locate.hpp"

namespace dotpose {
namespace {

template <typename Space, std::size_t Bytes>
core::Workspace* make_workspace(std::array<std::byte, Bytes>& bytes) {
    static_assert(sizeof(Space) <= Bytes, "Memory::kBytes is too small");
    static_assert(std::is_trivially_destructible_v<Space>, "nothing destroys it");
    return ::new (static_cast<void*>(bytes.data())) Space;
}

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

DeviceMemory::DeviceMemory() : workspace_(make_workspace<core::DeviceWorkspace>(bytes_)) {}
SmallMemory::SmallMemory() : workspace_(make_workspace<core::SmallWorkspace>(bytes_)) {}
LargeMemory::LargeMemory() : workspace_(make_workspace<core::LargeWorkspace>(bytes_)) {}

void RowLocator::set_options(const Options& options) {
    options_ = options;
    begun_ = Status::bad_argument;
}

Status RowLocator::begin(int width_px, int height_px) {
    return begun_ = core::begin(width_px, height_px, options_, *workspace_);
}

Status RowLocator::begin(int width_px, int height_px, const Prediction& prediction) {
    return begun_ = core::begin(width_px, height_px, options_, prediction, *workspace_);
}

void RowLocator::push_row(const std::uint8_t* pixels) {
    if (begun_ == Status::ok) core::push_row(pixels, options_, *workspace_);
}

Status RowLocator::end_rows() {
    const Status begun = begun_;
    begun_ = Status::bad_argument;
    return begun;
}

Trace RowLocator::trace() const {
    return trace_of(*workspace_, options_);
}

Fix RowLocator::shown(const Fix& fix) {
    begun_ = Status::bad_argument;
    workspace_->fix = fix;
    workspace_->fix.spacing_nm = options_.spacing_nm;
    return workspace_->fix;
}

Locator::Locator(SmallMemory& memory, const Options& options)
    : RowLocator(memory.workspace_, options) {}

Locator::Locator(LargeMemory& memory, const Options& options)
    : RowLocator(memory.workspace_, options) {}

Fix Locator::locate(const ImageView& image) {
    return shown(core::locate(image, options_, *workspace_));
}

Fix Locator::locate(const ImageView& image, const Prediction& prediction) {
    return shown(core::locate(image, options_, prediction, *workspace_));
}

CodeReading Locator::shown(CodeReading reading) {
    options_.profile = reading.code;
    reading.fix = shown(reading.fix);
    return reading;
}

CodeReading Locator::locate_in_any_code(const ImageView& image, const CodeEvidence& evidence) {
    return shown(core::locate_in_any_code(image, options_, nullptr, evidence, *workspace_));
}

CodeReading Locator::locate_in_any_code(const ImageView& image, const Prediction& prediction,
                                        const CodeEvidence& evidence) {
    return shown(core::locate_in_any_code(image, options_, &prediction, evidence, *workspace_));
}

CodeReading Locator::locate_in_code(const ImageView& image) {
    return shown(core::locate_in_code(image, options_, *workspace_));
}

Fix Locator::finish() {
    const Status begun = end_rows();
    return shown(begun == Status::ok ? core::finish(options_, *workspace_)
                                     : core::refuse(begun, *workspace_));
}

DeviceLocator::DeviceLocator(DeviceMemory& memory, const Options& options)
    : RowLocator(memory.workspace_, options) {}

Fix DeviceLocator::locate(const ImageView& image) {
    return shown(core::locate_as_device(image, options_, *workspace_));
}

Fix DeviceLocator::locate(const ImageView& image, const Prediction& prediction) {
    return shown(core::locate_as_device(image, options_, prediction, *workspace_));
}

Fix DeviceLocator::finish() {
    const Status begun = end_rows();
    return shown(begun == Status::ok ? core::finish_as_device(options_, *workspace_)
                                     : core::refuse(begun, *workspace_));
}

}  // namespace dotpose
