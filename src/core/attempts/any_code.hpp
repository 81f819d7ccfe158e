// Any code: the attempts, each in one profile after the other, until a place is certain among those
// of all profiles.
#pragma once

#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// See `dotpose::locate_in_any_code`; without a prediction, null.
CodeReading locate_in_any_code(const ImageView& image, const Options& options,
                               const Prediction* prediction, const CodeEvidence& evidence,
                               Workspace& w);

/// See `dotpose::locate_in_code`.
CodeReading locate_in_code(const ImageView& image, const Options& options, Workspace& w);

}  // namespace dotpose::core
