// Place evidence: finds the place of a block of bits, and decides whether the place is certain.
// Uses the code, the known sheets and the bits of earlier frames, but not the image.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/decode/bit_lines.hpp"
#include "core/integrity/confidence.hpp"
#include "core/kernels/kernels.hpp"
#include "core/known_sheets.hpp"
#include "core/other_codes.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "locate/earlier_bits.hpp"
#include "locate/hypothesis.hpp"

namespace dotpose::core {

/// Evidence for the place of a block, apart from the bits of the block.
struct PlaceEvidence {
    const Kernels& kernels;
    const DeviceOptions& options;
    const KnownSheets& known;
    EarlierBits& earlier;
    std::span<ScoredLine> line_scores;  ///< memory for the scores of the lines of a block
    OtherCodes* others;  ///< receives the odds of the other codes. Null if they are not requested
};

/// A quarter turn of a block, and the place of cell (0, 0) of the turned block.
struct TurnedPlace {
    int quarters = 0;
    Place place;
};

/// Finds the place of a block in the code. Prefers places on known sheets.
std::optional<TurnedPlace> find_turned_place(const PlaceEvidence& evidence, const BitBlock& block);

/// In a series of frames, stores the bits of the current frame. If the frames are read together,
/// replaces the bits with the bits of all frames instead, and returns false if the grids of the
/// frames do not match. The plane is relative to `from_centre`.
bool join_earlier(const FloatPlane& grid_from_image, FloatVec from_centre, EarlierBits& earlier,
                  BitBlock& block);

/// Returns the agreement of the bits that were read with the code, on x and y.
std::array<Confidence, 2> confidences_in(const BitsRead& bits);

/// Returns true if the bits make the place of the hypothesis certain. Also uses the bits of earlier
/// frames if frames are read together. If the place is certain, sets `p_wrong_log2` of the fix.
/// Depending on the evidence that was used, also sets `prior` or `frames`.
bool confirm_place(const PlaceEvidence& evidence, const Hypothesis& hypothesis,
                   const CellsInView& view, const BitBlock& block, const BitsRead& bits, Fix& fix);

}  // namespace dotpose::core
