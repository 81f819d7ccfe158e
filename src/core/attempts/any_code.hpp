// Any code: makes the attempts in one profile after the other, until a place is certain among the
// places of all profiles.
#pragma once

#include "core/workspace.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// See Locator::locate_in_any_code; `prediction` may be null.
CodeReading read_in_any_code(const ImageView& image, const Options& options,
                             const Prediction* prediction, const CodeEvidence& evidence,
                             Workspace& w);

/// See Locator::locate_in_code.
CodeReading read_in_code(const ImageView& image, const Options& options, Workspace& w);

}  // namespace dotpose::core
