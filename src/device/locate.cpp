// Implements DeviceLocator. This file must not depend on the desktop attempts, because
// scripts/export-device omits them.
#include "device/locate.hpp"

#include "core/steps.hpp"
#include "device/attempt.hpp"
#include "device/newest_rows.hpp"
#include "device/tracked.hpp"
#include "device/workspace.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::core {
namespace {

/// Starts a frame without a prediction. The frame size must be within the limits of the workspace.
void begin_fresh(int width_px, int height_px, const DeviceOptions& options, DeviceWorkspace& w) {
    w.is_tracking = false;
    begin_frame(width_px, height_px, w);
    w.keeps_frame =
        w.on_sheets != nullptr && w.on_sheets->begin_small(width_px, height_px, options, w);
}

}  // namespace

Fix locate_as_device(const ImageView& image, const DeviceOptions& options, DeviceWorkspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    begin_fresh(image.width_px, image.height_px, options, w);
    for (int v = 0; v < image.height_px; ++v)
        push_row(image.row(v), options, w);
    return finish_device_attempt(options, w);
}

Fix locate_as_device(const ImageView& image, const DeviceOptions& options,
                     const Prediction& prediction, DeviceWorkspace& w) {
    Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    status = begin_device_tracked(image.width_px, image.height_px, options, prediction, w);
    for (int v = 0; v < image.height_px && status == Status::ok; ++v)
        status = push_tracked_row(image.row(v), w);
    const bool is_tracked =
        status == Status::ok && finish_device_tracked(options, w).status == Status::ok;
    return is_tracked ? w.fix : locate_as_device(image, options, w);
}

Status begin(int width_px, int height_px, const DeviceOptions& options, DeviceWorkspace& w) {
    const Status status = check(width_px, height_px, options, w);
    if (status != Status::ok) return refuse(status, w).status;
    begin_fresh(width_px, height_px, options, w);
    return Status::ok;
}

Status begin(int width_px, int height_px, const DeviceOptions& options,
             const Prediction& prediction, DeviceWorkspace& w) {
    const Status status = check(width_px, height_px, options, w);
    if (status != Status::ok) return refuse(status, w).status;
    w.is_tracking = true;
    return begin_device_tracked(width_px, height_px, options, prediction, w);
}

void push_row(const std::uint8_t* pixels, const DeviceOptions& options, DeviceWorkspace& w) {
    if (w.is_tracking) {
        static_cast<void>(push_tracked_row(pixels, w));
    } else if (w.keeps_frame) {
        keep_row(pixels, w.tracking);
    } else {
        detect_row(pixels, options, w);
    }
}

const Fix& finish_as_device(const DeviceOptions& options, DeviceWorkspace& w) {
    return w.is_tracking ? finish_device_tracked(options, w) : finish_device_attempt(options, w);
}

}  // namespace dotpose::core

namespace dotpose {

template <int Width, int Height>
DeviceMemoryFor<Width, Height>::DeviceMemoryFor() {
    workspace_ = core::make_workspace<core::DeviceWorkspaceFor<Width, Height>>(bytes_);
}
template class DeviceMemoryFor<36, 36>;
template class DeviceMemoryFor<160, 120>;
template class DeviceMemoryFor<188, 120>;
template class DeviceMemoryFor<320, 240>;

DeviceLocator::DeviceLocator(AnyDeviceMemory& memory, const DeviceOptions& options)
    : RowLocator(memory.workspace_, options) {
    // Clears the known sheets, because another locator that used this memory may have set them.
    workspace().forget_known();
}

Status DeviceLocator::set_known(std::span<const KnownRegion> regions, OtherSheets others) {
    const core::KnownSheets sheets{regions, others};
    if (!sheets.are_valid()) return Status::bad_argument;
    workspace().set_known(sheets);
    return Status::ok;
}

core::DeviceWorkspace& DeviceLocator::workspace() {
    return static_cast<core::DeviceWorkspace&>(*workspace_);
}

Fix DeviceLocator::locate(const ImageView& image) {
    core::locate_as_device(image, options_, workspace());
    return finished();
}

Fix DeviceLocator::locate(const ImageView& image, const Prediction& prediction) {
    core::locate_as_device(image, options_, prediction, workspace());
    return finished();
}

Status DeviceLocator::begin(int width_px, int height_px) {
    return note_begin(core::begin(width_px, height_px, options_, workspace()), height_px);
}

Status DeviceLocator::begin(int width_px, int height_px, const Prediction& prediction) {
    return note_begin(core::begin(width_px, height_px, options_, prediction, workspace()),
                      height_px);
}

void DeviceLocator::push_row(const std::uint8_t* pixels) {
    if (takes_row()) core::push_row(pixels, options_, workspace());
}

Fix DeviceLocator::finish() {
    if (has_rows()) core::finish_as_device(options_, workspace());
    return finished();
}

}  // namespace dotpose
