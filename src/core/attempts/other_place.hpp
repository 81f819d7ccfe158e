// The place in another profile that explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// Fills in the place in another profile that explains a fix as well at another place, or the same
/// place in one that explains it better: if there is one.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Fills in the likeliest other place of a reading in the profile `read`.
void name_other_place(Profile read, Profile other, const OtherCodes& others, CodeReading& reading);

}  // namespace dotpose::core
