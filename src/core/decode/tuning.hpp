// Tuning: empirical constants of decoding. They were determined on the frames of `dotpose evaluate
// --preset hard --frames 4000 --seed 404`, on 3,000 frames with `--seed 5001`, and on the refused
// frames of seeds 777 and 778. docs/accuracy.md contains results for other frames. Some comments
// compare a constant with other values, by the number of frames located by
//
//     dotpose evaluate --preset hard --frames 2000 --seed 404
//
// The values in this file locate 1,994 frames. A difference of one frame is not significant. None
// of the compared values led to a wrong fix.
#pragma once

#include <array>
#include <cstddef>

namespace dotpose::core::tuning {

/// Bit weights from the darkness at the four places of a cell (decode/sample_cells).
namespace sample_cells {
/// Maximum number of cells in the sample for the median darkness and the median shade of a dot. The
/// medians hardly change if graphics cover a quarter of the cells.
inline constexpr std::size_t kMedianSample = 256;
/// Spacing divided by half the width of the square over which the darkness is averaged to get the
/// shade. The square is wider than a dot, but does not reach the dots of neighbouring cells.
inline constexpr int kShadePart = 5;
/// Offsets of the squares that are tested for graphics around a place, in 1/60 spacing. Four
/// squares are offset along one axis, and four squares diagonally. Together, the squares detect
/// every stroke that touches the dot.
inline constexpr int kBeside_60th = 8;
inline constexpr int kBesideDiagonally_60th = 5;
/// Darkness of solid ink relative to the paper level, in 1/256. A shade above the geometric mean of
/// this value and the shade of a typical dot counts as graphics. With half or twice the value,
/// 1,992 frames are located.
inline constexpr int kSolidInk_q8 = 230;
/// Reliability of the bits in a cell: a factor for their weights, in 1/16. The index is the number
/// of places of the cell that are in the image. Measured on hard frames.
inline constexpr std::array<int, 5> kReliabilityBySeen_q4{0, 6, 8, 10, 16};
/// Reliability of a cell with a place under graphics, in 1/16.
inline constexpr int kReliabilityCovered_q4 = 10;
/// Shade beside a place above which the cell counts as near graphics, in fifths of the shade above
/// which a place counts as graphics.
inline constexpr int kNearGraphics_5ths = 3;
/// Reliability of a cell near graphics, in 1/16. With a value of 3, 1,993 frames are located. With
/// a value of 14, 1,994 frames are located.
inline constexpr int kReliabilityNearGraphics_q4 = 7;
/// Darkness above which a cell's darkest place may be dirt, in tenths of the darkness of a typical
/// dot.
inline constexpr int kDark_10ths = 13;
/// Reliability of a cell whose darkest place may be dirt, in 1/16.
inline constexpr int kReliabilityDark_q4 = 12;
/// Darkness above which a cell's darkest place is probably dirt, in tenths of the darkness of a
/// typical dot.
inline constexpr int kTooDark_10ths = 16;
/// Reliability of a cell whose darkest place is probably dirt, in 1/16.
inline constexpr int kReliabilityTooDark_q4 = 6;
/// Weight of a bit whose two values differ by the darkness of a typical dot, before clamping to
/// 127. About two fifths of this difference already gives a weight of 127. A value of 150 locates
/// 1,994 frames, and a value of 600 locates 1,992 frames.
inline constexpr int kGain = 300;
/// Maximum light at a cell relative to the image centre, in 1/256. A brighter cell has the same
/// weights as a cell at this limit.
inline constexpr int kMaxLight_q8 = 1024;
/// Test for two patterns in one image. A cell has two dots if its second darkest place is dark
/// enough: its darkness is more than kSecondDot_3rds / 3 of a typical dot's darkness, and more than
/// kSecondDot_4ths / 4 of the darkness of the darkest place. The image shows two patterns if more
/// than kMaxCrowded_8ths / 8 of the cells have two dots. In hard frames, at most a quarter of the
/// cells had two dots.
inline constexpr int kSecondDot_3rds = 2;
inline constexpr int kSecondDot_4ths = 3;
inline constexpr int kMaxCrowded_8ths = 3;
}  // namespace sample_cells

/// Search by runs of lines (decode/search).
namespace search {
/// Maximum number of rolls to try per line.
inline constexpr int kChoices = 8;
/// Maximum number of runs, and readings per run, in the second attempt. Halving or doubling either
/// value does not change the number of located frames. The limits leave a margin for frames with
/// more misread bits.
inline constexpr int kRuns = 24;
inline constexpr int kReadings = 64;
/// Maximum number of runs, and readings per run, in the first attempt and on devices. These limits
/// bound the time for unreadable frames. None of 2,000 nominal frames needed more runs or readings,
/// and 4 of 2,000 hard frames did.
inline constexpr int kRunsBriefly = 3;
inline constexpr int kReadingsBriefly = 8;
}  // namespace search

/// Search by steps between adjacent lines (decode/step_search).
namespace step_search {
/// Number of places that are kept for each secondary sequence. All combinations of these places are
/// evaluated.
inline constexpr std::size_t kChoices = 3;
}  // namespace step_search

/// Vote on the quarter turn of the grid (decode/orientation, decode/bit_lines).
namespace turns {
/// Number of lines per axis that vote. Must be even. Several lines can outvote one misread line.
inline constexpr int kVoters = 4;
/// Number of lines per axis that vote if the bits are hard (0, 1 or not read).
inline constexpr int kVotersOfBits = 5;
/// Score difference between the two reading directions at which the vote ends early, summed over
/// the lines that have voted. Equals the score of 8 bits.
inline constexpr int kLandslide = 8 * 127;
/// Threshold for reporting a mirrored image: minimum agreement with the mirrored pattern, in
/// fourths of the agreement with the unmirrored pattern. Lines of random bits reach about 60 % of a
/// correct line's agreement.
inline constexpr int kMirrored_4ths = 5;
}  // namespace turns

}  // namespace dotpose::core::tuning
