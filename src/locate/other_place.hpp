// Other place: finds the place in another profile that explains a frame.
#pragma once

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"

namespace dotpose::core {

/// Fills in, if there is one, a place in another profile that explains a fix as well as its own
/// place does: elsewhere, or the same place if that profile explains it better.
void name_code_that_explains(const OtherCodes& others, CodeReading& reading);

/// Fills in the likeliest other place of a reading made in the profile `read`.
void name_other_place(Profile read, Profile other, const OtherCodes& others, CodeReading& reading);

}  // namespace dotpose::core
