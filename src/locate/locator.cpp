// Locator: manages the memory, the options, the evidence for the codes, and the pushed rows. The
// attempts are in locate/locate.cpp.
#include <algorithm>
#include <optional>
#include <span>

#include "core/steps.hpp"
#include "dotpose/locate.hpp"
#include "locate/after_motion.hpp"
#include "locate/locate.hpp"
#include "locate/workspace.hpp"

namespace dotpose {

SmallMemory::SmallMemory() : workspace_(core::make_workspace<core::SmallWorkspace>(bytes_)) {}
LargeMemory::LargeMemory() : workspace_(core::make_workspace<core::LargeWorkspace>(bytes_)) {}

Locator::Locator(core::DesktopWorkspace* workspace, const DeviceOptions& options)
    : RowLocator(workspace, options) {
    // Clears the series of images, the known sheets and the compared bits that another locator may
    // have left in the memory.
    workspace->earlier.clear();
    workspace->compared_bits = {};
    workspace->set_known({});
}

Status Locator::set_known(std::span<const KnownRegion> regions, OtherSheets others) {
    const core::KnownSheets sheets{regions, others};
    if (!sheets.are_valid()) return Status::bad_argument;
    workspace().set_known(sheets);
    return Status::ok;
}

void Locator::set_fixed_options(const DeviceOptions& options) {
    RowLocator::set_options(options);
    detects_code_ = false;
    evidence_ = {};
    error_rate_ = {};
}

DeviceOptions Locator::options_of_frame() const {
    DeviceOptions options = options_;
    int& bits_per_error = options.integrity.bits_per_error;
    if (bits_per_error == kMeasuredErrorRate) bits_per_error = error_rate_.bits_per_error();
    return options;
}

ComparedBits Locator::compared_bits() const {
    return static_cast<const core::DesktopWorkspace&>(*workspace_).compared_bits;
}

core::DesktopWorkspace& Locator::workspace() {
    return static_cast<core::DesktopWorkspace&>(*workspace_);
}

Fix Locator::locate_one(const ImageView& image, const Prediction* prediction) {
    if (!detects_code_) {
        core::locate(image, options_of_frame(), prediction, workspace());
        error_rate_.add(compared_bits());
        return finished();
    }
    const CodeReading reading = read_one(image, prediction, evidence_);
    evidence_ = reading.evidence;
    return reading.fix;
}

CodeReading Locator::read_one(const ImageView& image, const Prediction* prediction,
                              const CodeEvidence& evidence) {
    return finished(
        core::locate_in_any_code(image, options_of_frame(), prediction, evidence, workspace()));
}

std::optional<Prediction> Locator::begin_motion(const MeasuredMotion& since_last) {
    core::EarlierBits& earlier = workspace().earlier;
    if (options_.spacing_nm <= 0 || !since_last.is_usable()) {
        earlier.clear();
        return {};
    }
    earlier.begin_frame(since_last, options_);
    const Fix& last = workspace().fix;
    if (last.status != Status::ok) return {};
    return core::after(since_last, last, options_);
}

Fix Locator::locate(const ImageView& image) {
    workspace().earlier.clear();
    return locate_one(image, nullptr);
}

Fix Locator::locate(const ImageView& image, const Prediction& prediction) {
    workspace().earlier.clear();
    return locate_one(image, &prediction);
}

Fix Locator::locate(const ImageView& image, const MeasuredMotion& since_last) {
    const auto prediction = begin_motion(since_last);
    const Fix fix = locate_one(image, prediction ? &*prediction : nullptr);
    workspace().earlier.end_frame();
    return fix;
}

CodeReading Locator::finished(CodeReading reading) {
    error_rate_.add(compared_bits());
    options_.code = reading.code;
    workspace().fix = reading.fix;
    reading.fix = finished();
    return reading;
}

CodeReading Locator::locate_in_any_code(const ImageView& image, const CodeEvidence& evidence) {
    workspace().earlier.clear();
    return read_one(image, nullptr, evidence);
}

CodeReading Locator::locate_in_any_code(const ImageView& image, const Prediction& prediction,
                                        const CodeEvidence& evidence) {
    workspace().earlier.clear();
    return read_one(image, &prediction, evidence);
}

CodeReading Locator::locate_in_any_code(const ImageView& image, const MeasuredMotion& since_last,
                                        const CodeEvidence& evidence) {
    const auto prediction = begin_motion(since_last);
    const CodeReading reading = read_one(image, prediction ? &*prediction : nullptr, evidence);
    workspace().earlier.end_frame();
    return reading;
}

CodeReading Locator::locate_in_code(const ImageView& image) {
    workspace().earlier.clear();
    return finished(core::locate_in_code(image, options_of_frame(), workspace()));
}

Status Locator::begin(int width_px, int height_px) {
    core::DesktopWorkspace& w = workspace();
    w.compared_bits = {};
    Status status = core::check(width_px, height_px, options_, w);
    if (status == Status::ok && !w.pushed.begin(width_px, height_px))
        status = Status::image_too_large;
    if (status != Status::ok) core::refuse(status, w);
    return note_begin(status, height_px);
}

Status Locator::begin(int width_px, int height_px, const Prediction& prediction) {
    const Status status = begin(width_px, height_px);
    workspace().pushed.has_prediction = true;
    workspace().pushed.prediction = prediction;
    return status;
}

void Locator::push_row(const std::uint8_t* pixels) {
    if (takes_row()) workspace().pushed.add_row(pixels);
}

Fix Locator::finish() {
    if (!has_rows()) return finished();
    core::PushedImage& pushed = workspace().pushed;
    const ImageView image = pushed.completed();
    return pushed.has_prediction ? locate(image, pushed.prediction) : locate(image);
}

}  // namespace dotpose
