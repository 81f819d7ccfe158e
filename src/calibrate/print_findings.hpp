// Print findings: what the measurements of a print mean for its user.
#pragma once

#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

/// Sets `best_per_spacing`, `best` and `unread_patches` of a test page.
void rank_patches(CodeVariant code, PrintCheck& check);

/// Fills the findings from the fields, faults first.
void add_findings(const CheckPrintOptions& options, PrintCheck& check);

}  // namespace dotpose::calibrate
