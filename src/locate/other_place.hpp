// Other place: a place in another code that also explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// Sets the other place of `reading` if another code also explains the frame. In the other code, a
/// place that differs from the fix must be about as likely as the fix. The place of the fix itself
/// must be much more likely in the other code than in the code of the fix.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Sets the other place of `reading`: the likeliest place in the code `other`, apart from the place
/// of the fix. `read` is the code of the fix.
void name_other_place(CodeVariant read, CodeVariant other, const OtherCodes& others,
                      CodeReading& reading);

}  // namespace dotpose::core
