// Other place: a place in another code that also explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// Sets `has_other`, `other_code`, `other_cell` and `other_section` in `reading` if another code
/// also explains the frame. This is the case if a different place in the other code is about as
/// likely as the fix. It is also the case if the place of the fix is much more likely in the other
/// code than in the code of the fix.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Sets `other_code`, `other_cell` and `other_section` in `reading` to the most likely place in the
/// code `other` that is not the place of the fix. Also sets `has_other`. `read` is the code of the
/// fix.
void name_other_place(CodeVariant read, CodeVariant other, const OtherCodes& others,
                      CodeReading& reading);

/// Sets `has_other`, `other_code`, `other_cell` and `other_section` in `reading` from `any`, a
/// reading of the same frame in any code. If the two readings are in different codes, the place in
/// `any` becomes the other place. If they are in the same code, copies the other place from `any`,
/// if there is one. Does nothing if `any` has no place, or if `any` has more than one bit error per
/// kMinDotsPerBitError dots.
void note_other_reading(const CodeReading& any, CodeReading& reading);

}  // namespace dotpose::core
