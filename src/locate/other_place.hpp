// Other place: the place in another code that explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// Sets the place in another code that explains a fix as well as its own place, if there is one: at
/// another position, or at the same position if that code explains it better.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Sets the likeliest place in the code `other` for a reading in the code `read`.
void name_other_place(CodeVariant read, CodeVariant other, const OtherCodes& others,
                      CodeReading& reading);

}  // namespace dotpose::core
