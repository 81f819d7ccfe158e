// On sheets: finds and verifies places on known sheets. If a view has few cells, its place can be
// certain on the known sheets even if it would not be certain in the whole code.
#pragma once

#include <optional>

#include "core/decode/grid.hpp"
#include "core/integrity/known_places.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Returns false if only known sheets are possible, and no part of the decoded region is on a known
/// sheet. Otherwise, returns true.
bool is_possible(CodeVariant code, const Decoding& decoding, const KnownSheets& known);

/// Returns the most likely place of a block on the known sheets. Returns nullopt if the block has
/// no bits, if this place is in a code other than `options.code`, or if too many bits disagree with
/// the code at this place.
std::optional<KnownPlace> find_place_on_sheets(const Kernels& kernels, const DeviceOptions& options,
                                               const BitBlock& block, const KnownSheets& known);

/// Returns true if `place` is certain among the places on the known sheets. `block` must be
/// upright. Sets `p_wrong_log2` in the fix and, if the place is certain, also `prior`.
bool is_certain_on_sheets(const Kernels& kernels, const DeviceOptions& options, const Place& place,
                          const BitBlock& block, const KnownSheets& known, Fix& fix);

/// Finds the position of the decoded region on the known sheets. Returns true if a position is
/// found and is certain. If a position is found, sets `bit_errors` and `p_wrong_log2` in the fix.
/// If the position is certain, also sets the decoding, and `prior` in the fix.
bool read_on_sheets(const Kernels& kernels, const DeviceOptions& options, const Grid& grid,
                    const KnownSheets& known, Decoding& decoding, Fix& fix);

}  // namespace dotpose::core
