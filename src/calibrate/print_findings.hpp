// Converts the measurements of a print into messages for the user.
#pragma once

#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

/// For a test page, sets `best_per_spacing`, `best` and `unread_patches` of `check`.
void rank_patches(CodeVariant code, PrintCheck& check);

/// Sets `check.findings` from the measured fields. Faults come before remarks.
void add_findings(const CheckPrintOptions& options, PrintCheck& check);

}  // namespace dotpose::calibrate
