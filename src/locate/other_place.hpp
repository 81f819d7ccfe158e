// Other place: the place in another code that explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// Sets the other place of `reading` if another code explains the frame: to a different place that
/// is about as likely as the fix, or to the same place if the other code explains the frame much
/// better.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Sets the other place of `reading` to the likeliest different place in the code `other`. `read`
/// is the code of the fix.
void name_other_place(CodeVariant read, CodeVariant other, const OtherCodes& others,
                      CodeReading& reading);

}  // namespace dotpose::core
