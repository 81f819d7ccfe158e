// Other place: the place in another code that explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// If a place in another code explains the frame as well as the fix, sets this place in `reading`.
/// This place is at another position, or at the same position if the other code explains the frame
/// better.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Sets the likeliest place in the code `other` for a reading in the code `read`.
void name_other_place(CodeVariant read, CodeVariant other, const OtherCodes& others,
                      CodeReading& reading);

}  // namespace dotpose::core
