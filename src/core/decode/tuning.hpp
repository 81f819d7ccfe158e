// Tuning: empirical constants of decoding. The constants were determined on the frames of `dotpose
// evaluate --preset hard --frames 4000 --seed 404`, on 3,000 frames with `--seed 5001`, and on the
// refused frames of seeds 777 and 778. docs/accuracy.md shows that the constants also suit other
// frames. Comments state the number of frames that `dotpose evaluate --preset hard --frames 2000
// --seed 404` locates with other values. With the values in this file, it locates 1,994. No fix was
// wrong with any of the values. A difference of one frame is not significant.
#pragma once

#include <array>
#include <cstddef>

namespace dotpose::core::tuning {

/// Reading of bits from the darkness at the four places of a cell (decode/sample_cells).
namespace sample_cells {
/// Maximum number of sampled cells. The medians over these cells are the darkness and the shade of
/// a typical dot. Even if graphics cover a quarter of the cells, the medians hardly change.
inline constexpr std::size_t kMedianSample = 256;
/// Half the side of the square for the shade of a place, as a part (1/n) of the spacing. The square
/// is wider than a dot and does not reach the dots of neighbouring cells.
inline constexpr int kShadePart = 5;
/// Distances from a place to the squares that are tested for graphics, in 1/60 spacings, along the
/// axes and diagonally. With these distances, the test finds every stroke that touches the dot.
inline constexpr int kBeside_60th = 8;
inline constexpr int kBesideDiagonally_60th = 5;
/// Darkness of solid ink relative to the paper level, in 1/256. A shade above the geometric mean of
/// this value and the shade of a typical dot counts as graphics. Frames located with half or twice
/// the value: 1,992.
inline constexpr int kSolidInk_q8 = 230;
/// Reliability of the bits of a cell, in 1/16, indexed by the number of its places in the image.
/// Measured on hard frames.
inline constexpr std::array<int, 5> kReliabilityBySeen_q4{0, 6, 8, 10, 16};
/// Reliability, in 1/16, of the bits of a cell with a place under graphics.
inline constexpr int kReliabilityCovered_q4 = 10;
/// Minimum shade next to a place, in fifths of the minimum shade of graphics, at which the cell
/// counts as near graphics.
inline constexpr int kNearGraphics_5ths = 3;
/// Reliability, in 1/16, of the bits of a cell near graphics. Frames located with 3: 1,993; with
/// 14: 1,994.
inline constexpr int kReliabilityNearGraphics_q4 = 7;
/// Minimum darkness, in tenths of the darkness of a typical dot, at which the darkest place of a
/// cell may be dirt.
inline constexpr int kDark_10ths = 13;
/// Reliability, in 1/16, of the bits of a cell whose darkest place may be dirt.
inline constexpr int kReliabilityDark_q4 = 12;
/// Minimum darkness, in tenths of the darkness of a typical dot, at which the darkest place of a
/// cell is probably dirt.
inline constexpr int kTooDark_10ths = 16;
/// Reliability, in 1/16, of the bits of a cell whose darkest place is probably dirt.
inline constexpr int kReliabilityTooDark_q4 = 6;
/// Weight of a bit whose places differ by the darkness of a dot, before the limit of 127. A
/// difference of two fifths of the darkness of a dot reaches the limit. Frames located with 150:
/// 1,994; with 600: 1,992.
inline constexpr int kGain = 300;
/// Maximum light of a cell relative to the centre of the image, in 1/256. Brighter light does not
/// increase the weights.
inline constexpr int kMaxLight_q8 = 1024;
/// A cell counts as having two dots if the darkness of its second darkest place exceeds both
/// kSecondDot_3rds / 3 of the darkness of a typical dot and kSecondDot_4ths / 4 of the darkness of
/// its darkest place. The image contains two patterns if more than kMaxCrowded_8ths / 8 of the
/// cells have two dots. In hard frames, at most a quarter of the cells had two dots.
inline constexpr int kSecondDot_3rds = 2;
inline constexpr int kSecondDot_4ths = 3;
inline constexpr int kMaxCrowded_8ths = 3;
}  // namespace sample_cells

/// Search for the position that agrees best with all lines (decode/search).
namespace search {
/// Maximum number of rolls to try for one line.
inline constexpr int kChoices = 8;
/// Maximum number of runs of lines, and of readings per run, in the second attempt. Frames located
/// with half or twice either number: 1,994. The present values leave a margin for frames with more
/// misread bits than these frames.
inline constexpr int kRuns = 24;
inline constexpr int kReadings = 64;
/// Maximum number of runs, and of readings per run, in the first attempt and on devices. None of
/// 2,000 nominal frames and 4 of 2,000 hard frames needed more. These limits bound the time for
/// unreadable frames.
inline constexpr int kRunsBriefly = 3;
inline constexpr int kReadingsBriefly = 8;
}  // namespace search

/// Search for the position by the steps between adjacent lines (decode/step_search).
namespace step_search {
/// Number of places kept in each of the four secondary sequences. All combinations of these places
/// are compared.
inline constexpr std::size_t kChoices = 3;
}  // namespace step_search

/// Search for the quarter turn of the grid (decode/orientation, decode/bit_lines).
namespace turns {
/// Number of lines per axis that vote on the turn. Must be even. The vote of several lines
/// outweighs one misread line.
inline constexpr int kVoters = 4;
/// Number of lines per axis that vote on the turn if bits are hard.
inline constexpr int kVotersOfBits = 5;
/// The vote ends early if the summed scores of the two reading directions (forwards and backwards)
/// differ by at least this value, which is the score of 8 bits.
inline constexpr int kLandslide = 8 * 127;
/// The image counts as mirrored if its agreement with the mirrored pattern exceeds this value, in
/// fourths of its agreement with the pattern. Lines of random bits have about 60 % of the agreement
/// of lines of the main sequence.
inline constexpr int kMirrored_4ths = 5;
}  // namespace turns

}  // namespace dotpose::core::tuning
