// Tuning: empirical constants of decoding. They were determined on the frames of `dotpose evaluate
// --preset hard --frames 4000 --seed 404`, on 3,000 frames with `--seed 5001`, and on the refused
// frames of seeds 777 and 778. docs/accuracy.md contains results for other frames. Some comments
// state how many frames are located with other values of a constant, as printed by the command
//
//     dotpose evaluate --preset hard --frames 2000 --seed 404
//
// With the values in this file, 1,994 of the 2,000 frames are located. A difference of one frame is
// not significant. None of the other values led to a wrong fix.
#pragma once

#include <array>
#include <cstddef>

namespace dotpose::core::tuning {

/// Bit weights, computed from the darkness at the four dot positions of a cell
/// (decode/sample_cells).
namespace sample_cells {
/// Maximum number of cells that are sampled to find the median darkness and shade of a dot. The
/// medians hardly change if graphics cover a quarter of the cells.
inline constexpr std::size_t kMedianSample = 256;
/// The *shade* of a dot position is the mean darkness of a square around it. The half-width of this
/// square is 1/kShadePart of the spacing. The square is wider than a dot, but does not reach the
/// dots of neighbouring cells.
inline constexpr int kShadePart = 5;
/// Offsets from a dot position to the eight squares that are tested for graphics, in units of 1/60
/// of the spacing. Four squares are offset along one axis, and four squares are offset diagonally.
/// Together, they detect any stroke that touches the dot.
inline constexpr int kBeside_60th = 8;
inline constexpr int kBesideDiagonally_60th = 5;
/// Darkness of solid ink relative to the paper level, in units of 1/256. A dot position is
/// considered to be under graphics if its shade, or the shade beside it, exceeds the geometric mean
/// of this value and the shade of a typical dot. If this value is halved or doubled, only 1,992
/// frames are located.
inline constexpr int kSolidInk_q8 = 230;
/// Reliability of the bits in a cell: a factor for their weights, in units of 1/16. The index is
/// the number of dot positions of the cell that are in the image.
inline constexpr std::array<int, 5> kReliabilityBySeen_q4{0, 6, 8, 10, 16};
/// Reliability of a cell that has a dot position under graphics, in units of 1/16.
inline constexpr int kReliabilityCovered_q4 = 10;
/// A cell is near graphics if the shade beside one of its dot positions exceeds
/// kNearGraphics_5ths / 5 of the limit above which a dot position is considered to be under
/// graphics.
inline constexpr int kNearGraphics_5ths = 3;
/// Reliability of a cell near graphics, in units of 1/16. The number of located frames is 1,993
/// with a value of 3, and 1,994 with a value of 14.
inline constexpr int kReliabilityNearGraphics_q4 = 7;
/// If the darkest dot position of a cell is darker than this, it may be dirt. The unit is a tenth
/// of the darkness of a typical dot.
inline constexpr int kDark_10ths = 13;
/// Reliability of a cell whose darkest dot position may be dirt, in units of 1/16.
inline constexpr int kReliabilityDark_q4 = 12;
/// If the darkest dot position of a cell is darker than this, it is probably dirt. The unit is a
/// tenth of the darkness of a typical dot.
inline constexpr int kTooDark_10ths = 16;
/// Reliability of a cell whose darkest dot position is probably dirt, in units of 1/16.
inline constexpr int kReliabilityTooDark_q4 = 6;
/// Bit weight per unit of contrast, before clamping to 127. The contrast of a bit is the difference
/// in darkness between the dot positions for bit values 1 and 0, relative to a typical dot. A
/// contrast of 0.42 is enough for the maximum weight. The number of located frames is 1,994 with a
/// value of 150, and 1,992 with a value of 600.
inline constexpr int kGain = 300;
/// Maximum ratio of the paper level at a cell to the paper level at the image centre, in units of
/// 1/256. Larger ratios are clamped to this value.
inline constexpr int kMaxLight_q8 = 1024;
/// Limits of the test for two patterns in one image. A cell is considered to have two dots if the
/// darkness of its second darkest dot position exceeds both kSecondDot_3rds / 3 of the darkness of
/// a typical dot and kSecondDot_4ths / 4 of the darkness of its darkest dot position. The image is
/// considered to show two patterns if more than kMaxCrowded_8ths / 8 of the completely visible
/// cells have two dots. In hard frames, at most a quarter of these cells had two dots.
inline constexpr int kSecondDot_3rds = 2;
inline constexpr int kSecondDot_4ths = 3;
inline constexpr int kMaxCrowded_8ths = 3;
}  // namespace sample_cells

/// Search for the position in runs of consecutive lines (decode/search).
namespace search {
/// Maximum number of rolls to try per line.
inline constexpr int kChoices = 8;
/// Maximum number of runs, and of readings per run, in the second attempt. A reading is the
/// position for one combination of rolls. Halving or doubling either value does not change the
/// number of located frames. The limits leave a margin for frames with more misread bits.
inline constexpr int kRuns = 24;
inline constexpr int kReadings = 64;
/// Maximum number of runs, and of readings per run, in the first attempt and on devices. These
/// limits bound the time for unreadable frames. None of 2,000 nominal frames needed higher limits,
/// but 4 of 2,000 hard frames did.
inline constexpr int kRunsBriefly = 3;
inline constexpr int kReadingsBriefly = 8;
}  // namespace search

/// Search by steps between adjacent lines (decode/step_search).
namespace step_search {
/// Number of starting indices kept for each secondary sequence. All combinations of these indices
/// are evaluated.
inline constexpr std::size_t kChoices = 3;
}  // namespace step_search

/// Vote on the turn of the grid, in quarter turns (decode/orientation, decode/bit_lines).
namespace turns {
/// Number of lines per axis that vote. Must be even, because the lines are scored in pairs.
inline constexpr int kVoters = 4;
/// Number of lines per axis that vote if the bits are hard (0, 1 or not read).
inline constexpr int kVotersOfBits = 5;
/// The vote ends early when the difference between the total scores of the two reading directions
/// reaches this value, which is the score of 8 bits.
inline constexpr int kLandslide = 8 * 127;
/// The image is reported as mirrored if the agreement with the mirrored pattern exceeds
/// kMirrored_4ths / 4 of the agreement with the unmirrored pattern. Lines of random bits reach
/// about 60 % of a correct line's agreement.
inline constexpr int kMirrored_4ths = 5;
}  // namespace turns

}  // namespace dotpose::core::tuning
