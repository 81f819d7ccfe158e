// Other place: a place in another code that also explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// Sets the other place of `reading` if another code also explains the frame. A different place
/// must be about as likely as the fix. At the same place, the other code must explain the frame
/// much better.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Sets the other place of `reading`: the likeliest place in the code `other`, apart from the place
/// of the fix. `read` is the code of the fix.
void name_other_place(CodeVariant read, CodeVariant other, const OtherCodes& others,
                      CodeReading& reading);

}  // namespace dotpose::core
