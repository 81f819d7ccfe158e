// Chooses the attempts for a frame once its arguments are known to be harmless, and implements the
// class that desktops use.
#include "core/locate.hpp"

#include "core/attempts/any_code.hpp"
#include "core/attempts/device.hpp"
#include "core/attempts/first.hpp"
#include "core/attempts/rows.hpp"
#include "core/attempts/second.hpp"
#include "core/attempts/tracked.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::core {
namespace {

/// Makes the attempts that desktops make.
Fix locate_by_attempts(const ImageView& image, const Options& options, Workspace& w) {
    const bool may_try_twice = options.effort == Effort::twice && w.has_second_attempt;
    if (!may_try_twice) return *make_first_attempt(image, options, Rough::counted, w);
    const std::optional<Fix> first = make_first_attempt(image, options, Rough::left, w);
    const bool has_failed = first && first->status != Status::ok;
    if (first && !has_failed && !is_rough(*first)) return *first;
    const Fix second = make_second_attempt(image, options, w);
    if (second.status == Status::ok || has_failed) return second;
    // The frame was left, or the workspace must match the rough fix that is returned.
    return *make_first_attempt(image, options, Rough::counted, w);
}

/// Gives a frame without a fix the status `mirrored` if an attempt saw the code as in a mirror. The
/// steps after that attempt fail for other reasons, such as a grid that they do not find.
void name_mirror_image(Fix& fix, Workspace& w) {
    if (fix.status != Status::ok && w.is_mirrored) fix.status = w.fix.status = Status::mirrored;
}

}  // namespace

Fix locate(const ImageView& image, const Options& options, Workspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    if (options.effort == Effort::device) return locate_as_device(image, options, w);
    w.is_mirrored = false;
    Fix fix = locate_by_attempts(image, options, w);
    name_mirror_image(fix, w);
    return fix;
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
    w.is_mirrored = false;
    CodeReading reading = read_in_any_code(image, options, prediction, evidence, w);
    name_mirror_image(reading.fix, w);
    return reading;
}

CodeReading locate_in_code(const ImageView& image, const Options& options, Workspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return {refuse(status, w), options.profile, {}};
    return read_in_code(image, options, w);
}

Fix finish(const Options& options, Workspace& w) {
    if (w.tracking.is_on || options.effort == Effort::device) return finish_as_device(options, w);
    return finish_rows(options, w);
}

}  // namespace dotpose::core

namespace dotpose {

SmallMemory::SmallMemory() : workspace_(core::make_workspace<core::SmallWorkspace>(bytes_)) {}
LargeMemory::LargeMemory() : workspace_(core::make_workspace<core::LargeWorkspace>(bytes_)) {}

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

}  // namespace dotpose
