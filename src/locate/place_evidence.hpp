// Place evidence: finds the place of a block of bits, and decides whether the place is certain.
// Uses the code, the known sheets and the bits of earlier frames, but not the image.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/decode/bit_lines.hpp"
#include "core/integrity/confidence.hpp"
#include "core/integrity/work_limit.hpp"
#include "core/kernels/kernels.hpp"
#include "core/known_sheets.hpp"
#include "core/other_codes.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "locate/earlier_bits.hpp"
#include "locate/hypothesis.hpp"

namespace dotpose::core {

/// Inputs and memory for finding and testing the place of a block of bits: the options, the known
/// sheets, and the bits of earlier frames. The block itself is passed separately.
struct PlaceEvidence {
    const Kernels& kernels;
    const DeviceOptions& options;
    const KnownSheets& known;
    EarlierBits& earlier;
    std::span<ScoredLine> line_scores;  ///< memory for the line scores of a block
    OtherCodes* others;                 ///< receives the odds of the other codes, unless it is null
    WorkLimit& work;                    ///< remaining work of this attempt
};

/// A quarter turn of a block, and the place of cell (0, 0) of the turned block.
struct TurnedPlace {
    int quarters = 0;
    Place place;
};

/// Thoroughness of the search for a place.
enum class PlaceSearch : std::uint8_t {
    brief,  ///< searches only at the most likely quarter turn
    /// If the brief search finds no place that agrees with the bits, searches thoroughly at all
    /// quarter turns. Blocks of few cells need the thorough search, because many of their lines are
    /// too short to determine the roll, or to vote for a quarter turn.
    thorough,
};

/// Finds the place of a block in the code. Prefers places on known sheets. Returns nullopt if no
/// place is found, or if only known sheets are possible and the place is not on a known sheet.
std::optional<TurnedPlace> find_turned_place(const PlaceEvidence& evidence, const BitBlock& block,
                                             PlaceSearch search);

/// Combines a block with a series of frames. `from_centre` is the origin of the coordinates of
/// `grid_from_image`, relative to the image centre.
/// - Outside a series, does nothing and returns true.
/// - Within a series, stores the bits of the current frame and returns true.
/// - If frames are being read together, adds the bits of the earlier frames to the block instead.
///   Returns false if the grids of the frames do not match.
bool join_earlier(const FloatPlane& grid_from_image, FloatVec from_centre, EarlierBits& earlier,
                  BitBlock& block);

/// Returns the agreement of the bits with the code: the number of bits read and the number of wrong
/// bits, for x and for y.
std::array<Confidence, 2> confidences_in(const BitsRead& bits);

/// Returns true if the bits make the place of the hypothesis certain. If frames are being read
/// together, also uses the bits of earlier frames. If the place is certain, sets `p_wrong_log2` in
/// the fix. Also sets `prior` if known sheets were needed, and `frames` if earlier frames were
/// needed. Within a series of frames, stores the block for the following frames.
bool confirm_place(const PlaceEvidence& evidence, const Hypothesis& hypothesis,
                   const CellsInView& view, const BitBlock& block, const BitsRead& bits, Fix& fix);

}  // namespace dotpose::core
