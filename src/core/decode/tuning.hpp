// Tuning: empirical constants of decoding. The constants were determined on the frames of `dotpose
// evaluate --preset hard --frames 4000 --seed 404`, on 3,000 frames with `--seed 5001`, and on the
// refused frames of seeds 777 and 778. docs/accuracy.md shows that the constants also suit other
// frames. Comments state the number of frames that `dotpose evaluate --preset hard --frames 2000
// --seed 404` locates with other values. With the values in this file, the command locates 1,994 of
// the 2,000 frames. None of the values led to a wrong fix. A difference of one frame is not
// significant.
#pragma once

#include <array>
#include <cstddef>

namespace dotpose::core::tuning {

/// Reading of bits from the darkness at the four places of a cell (decode/sample_cells).
namespace sample_cells {
/// Maximum number of cells from which the darkness and the shade of a typical dot are computed, as
/// medians. The medians hardly change even if graphics cover a quarter of the cells.
inline constexpr std::size_t kMedianSample = 256;
/// The shade of a place is averaged over a square whose side is 2 / kShadePart of the spacing. The
/// square is wider than a dot, but does not reach the dots of neighbouring cells.
inline constexpr int kShadePart = 5;
/// Offsets from a place to the centres of the squares that are tested for graphics, in units of
/// 1/60 spacing. Four squares are offset by kBeside_60th along one axis, and four squares by
/// kBesideDiagonally_60th along each axis. With these offsets, the test detects every stroke that
/// touches the dot.
inline constexpr int kBeside_60th = 8;
inline constexpr int kBesideDiagonally_60th = 5;
/// Darkness of solid ink relative to the paper level, in 1/256. A shade above the geometric mean of
/// this value and the shade of a typical dot counts as graphics. With half or twice this value,
/// 1,992 frames are located.
inline constexpr int kSolidInk_q8 = 230;
/// Reliability of the bits of a cell, in 1/16, indexed by the number of places of the cell that are
/// in the image. Measured on hard frames.
inline constexpr std::array<int, 5> kReliabilityBySeen_q4{0, 6, 8, 10, 16};
/// Reliability, in 1/16, of the bits of a cell with a place under graphics.
inline constexpr int kReliabilityCovered_q4 = 10;
/// Shade next to a place above which the cell counts as near graphics, in fifths of the minimum
/// shade of graphics.
inline constexpr int kNearGraphics_5ths = 3;
/// Reliability, in 1/16, of the bits of a cell near graphics. With a value of 3, 1,993 frames are
/// located. With a value of 14, 1,994 frames are located.
inline constexpr int kReliabilityNearGraphics_q4 = 7;
/// Darkness above which the darkest place of a cell may be dirt, in tenths of the darkness of a
/// typical dot.
inline constexpr int kDark_10ths = 13;
/// Reliability, in 1/16, of the bits of a cell whose darkest place may be dirt.
inline constexpr int kReliabilityDark_q4 = 12;
/// Darkness above which the darkest place of a cell is probably dirt, in tenths of the darkness of
/// a typical dot.
inline constexpr int kTooDark_10ths = 16;
/// Reliability, in 1/16, of the bits of a cell whose darkest place is probably dirt.
inline constexpr int kReliabilityTooDark_q4 = 6;
/// Weight of a bit, before clamping to 127, if the darkness of its places differs by the darkness
/// of a typical dot. A difference of about two fifths of this darkness reaches the limit of 127.
/// With a value of 150, 1,994 frames are located. With a value of 600, 1,992 frames are located.
inline constexpr int kGain = 300;
/// Maximum ratio of the light at a cell to the light at the centre of the image, in 1/256. Brighter
/// light does not increase the weights further.
inline constexpr int kMaxLight_q8 = 1024;
/// A cell counts as a cell with two dots if the darkness of its second darkest place exceeds both
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
/// Maximum number of runs of lines, and of readings per run, in the second attempt. Halving or
/// doubling either limit does not change the number of located frames. The chosen values leave a
/// margin for frames with more misread bits.
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
/// are evaluated.
inline constexpr std::size_t kChoices = 3;
}  // namespace step_search

/// Search for the quarter turn of the grid (decode/orientation, decode/bit_lines).
namespace turns {
/// Number of lines per axis that vote on the turn. Must be even. Several lines can outvote one
/// misread line.
inline constexpr int kVoters = 4;
/// Number of lines per axis that vote on the turn if the bits are hard (0, 1 or not read).
inline constexpr int kVotersOfBits = 5;
/// Difference between the summed scores of the two reading directions (forwards and backwards) at
/// which the vote ends early. The value is the score of 8 bits.
inline constexpr int kLandslide = 8 * 127;
/// Agreement with the mirrored pattern above which an image counts as mirrored, in fourths of its
/// agreement with the unmirrored pattern. Lines of random bits reach about 60 % of the agreement of
/// lines of the main sequence.
inline constexpr int kMirrored_4ths = 5;
}  // namespace turns

}  // namespace dotpose::core::tuning
