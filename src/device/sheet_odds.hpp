// Sheet odds: computes, in integers, an upper bound on the probability that a place on the known
// sheets is wrong. docs/integrity.md, "Known sheets", derives the bound.
#pragma once

#include <array>

#include "core/known_sheets.hpp"
#include "device/hard_block.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Returns an upper bound on the number of wrong bits, summed over both axes, at which a place can
/// be certain. `dots` is the number of bits per axis. `lines` is the number of columns or rows,
/// whichever is larger. Returns -1 if no place can be certain.
int max_wrong_bits(const KnownSheets& sheets, CodeVariant code, int dots, int lines,
                   const IntegrityOptions& options);

/// Returns true if a place on the known sheets is certain. A place is certain if
/// - log2 of the bound on its probability of being wrong is at most
///   IntegrityOptions::max_p_wrong_log2, and
/// - the fraction of wrong bits on each axis, in units of 1/256, is at most
///   IntegrityOptions::max_bit_error_q8.
///
/// `columns` and `rows` are the lines of the upright block, and `corner` is the place where the
/// first column and the first row cross. If the result is true, sets `bit_errors`, `p_wrong_log2`
/// and `prior` in the fix. Otherwise, may set `bit_errors` and `p_wrong_log2`.
bool is_certain_place(const KnownSheets& sheets, CodeVariant code, const HardLines& columns,
                      const HardLines& rows, const Place& corner, const IntegrityOptions& options,
                      Fix& fix);

}  // namespace dotpose::core
