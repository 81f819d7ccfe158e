// Chooses the attempts for a frame once its arguments are known to be harmless, and implements the
// classes that callers use.
#include "core/locate.hpp"

#include <array>
#include <cstddef>
#include <new>
#include <span>
#include <type_traits>

#include "core/attempts/any_code.hpp"
#include "core/attempts/device.hpp"
#include "core/attempts/device_tracked.hpp"
#include "core/attempts/first.hpp"
#include "core/attempts/rows.hpp"
#include "core/attempts/second.hpp"
#include "core/attempts/steps.hpp"
#include "core/attempts/tracked.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::core {
namespace {

constexpr bool is_within(int value, int low, int high) {
    return value >= low && value <= high;
}

/// Whether the options are such that no stage can overflow. Not checked, because no value does
/// harm: the lens's k (see bend_q48), most_dots (clamped), show_stages.
bool are_valid(const Options& options) {
    constexpr int kFarthestReference_q8 = 16384 * 256;
    constexpr int kFarthestLens_q8 = 1024 * 256;
    constexpr int kMost = 1 << 20;  // 256 times this still fits into 32 bits, with a factor of two
                                    // to spare
    return options.profile <= Profile::microdots && options.effort <= Effort::twice &&
           options.decoder <= Decoder::all && is_within(options.threshold.low_q8, 1, 256) &&
           is_within(options.threshold.high_q8, 1, 256) &&
           is_within(options.threshold.min_contrast, 1, 255) &&
           is_within(options.blobs.min_area_px, 0, kMost) &&
           is_within(options.blobs.min_mass_q8, 0, 256) &&
           is_within(options.blobs.max_area_ratio, 1, 1024) &&
           is_within(options.lattice.min_dots, 0, kMost) &&
           is_within(options.lattice.max_offset_q16, 0, 32768) &&
           is_within(options.integrity.max_p_wrong_log2, -kMost, 0) &&
           is_within(options.integrity.max_bit_error_q8, 0, 256) &&
           is_within(options.reference_dx_q8, -kFarthestReference_q8, kFarthestReference_q8) &&
           is_within(options.reference_dy_q8, -kFarthestReference_q8, kFarthestReference_q8) &&
           is_within(options.lens.centre_dx_q8, -kFarthestLens_q8, kFarthestLens_q8) &&
           is_within(options.lens.centre_dy_q8, -kFarthestLens_q8, kFarthestLens_q8);
}

/// Returns ok if a frame can be begun, otherwise the reason.
Status check(int width_px, int height_px, const Options& options, const Workspace& w) {
    if (!are_valid(options)) return Status::bad_argument;
    if (width_px < kMinFrameSide_px || height_px < kMinFrameSide_px) {
        return Status::image_too_small;
    }
    if (width_px > w.max_width_px || height_px > kMaxFrameSide_px) return Status::image_too_large;
    return Status::ok;
}

/// Returns ok if an image can be located, otherwise the reason.
Status check(const ImageView& image, const Options& options, const Workspace& w) {
    const Status status = check(image.width_px, image.height_px, options, w);
    return status == Status::ok && image.pixels == nullptr ? Status::bad_argument : status;
}

}  // namespace

const Fix& refuse(Status reason, Workspace& w) {
    forget_frame(w);
    w.fix.status = reason;
    return w.fix;
}

Fix locate(const ImageView& image, const Options& options, Workspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    if (options.effort == Effort::device) return locate_as_device(image, options, w);
    const Fix fix = make_first_attempt(image, options, w);
    const bool is_good = fix.status == Status::ok && !is_rough(fix);
    if (is_good || options.effort == Effort::once || !w.has_second_attempt) return fix;
    const Fix second = make_second_attempt(image, options, w);
    if (second.status == Status::ok || fix.status != Status::ok) return second;
    return make_first_attempt(image, options, w);  // The workspace must match the fix that is
                                                   // returned.
}

Fix locate(const ImageView& image, const Options& options, const Prediction& prediction,
           Workspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    if (options.effort == Effort::device) return locate_as_device(image, options, prediction, w);
    const bool is_tracked = locate_tracked(kernels(), image, options, prediction, w);
    return is_tracked ? w.fix : locate(image, options, w);
}

CodeReading locate_in_any_code(const ImageView& image, const Options& options,
                               const Prediction* prediction, const CodeEvidence& evidence,
                               Workspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return {refuse(status, w), options.profile, evidence};
    return read_in_any_code(image, options, prediction, evidence, w);
}

CodeReading locate_in_code(const ImageView& image, const Options& options, Workspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return {refuse(status, w), options.profile, {}};
    return read_in_code(image, options, w);
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

Fix finish(const Options& options, Workspace& w) {
    if (w.tracking.is_on || options.effort == Effort::device) return finish_as_device(options, w);
    return finish_rows(options, w);
}

const Fix& finish_as_device(const Options& options, Workspace& w) {
    return w.tracking.is_on ? finish_device_tracked(options, w) : finish_device_attempt(options, w);
}

}  // namespace dotpose::core

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

Locator::Locator(SmallMemory& memory, const Options& options)
    : RowLocator(memory.workspace_, options) {}

Locator::Locator(LargeMemory& memory, const Options& options)
    : RowLocator(memory.workspace_, options) {}

Fix Locator::locate(const ImageView& image) {
    core::locate(image, options_, *workspace_);
    return shown();
}

Fix Locator::locate(const ImageView& image, const Prediction& prediction) {
    core::locate(image, options_, prediction, *workspace_);
    return shown();
}

CodeReading Locator::shown(CodeReading reading) {
    options_.profile = reading.code;
    workspace_->fix = reading.fix;
    reading.fix = shown();
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
    if (has_rows()) core::finish(options_, *workspace_);
    return shown();
}

DeviceLocator::DeviceLocator(DeviceMemory& memory, const Options& options)
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
