// Tuning: empirical constants of decoding. The constants were determined on the frames of `dotpose
// evaluate --preset hard --frames 4000 --seed 404`, on 3,000 frames with `--seed 5001`, and on the
// refused frames of seeds 777 and 778. docs/accuracy.md shows that the constants suit other frames.
// Comments state the number of frames that `dotpose evaluate --preset hard --frames 2000 --seed
// 404` locates with other values. With the values in this file, it locates 1,994; no fix is wrong
// with any value. A difference of one frame is due to chance.
#pragma once

#include <array>
#include <cstddef>

namespace dotpose::core::tuning {

/// Bits from the darkness at the four places of a cell (decode/sample_cells).
namespace sample_cells {
/// Maximum number of cells whose median defines the typical dot. If graphics cover a quarter of the
/// cells, the median hardly changes.
inline constexpr std::size_t kMedianSample = 256;
/// Half the side of the square for the shade of a place, as a part (1/n) of the spacing. The square
/// is wider than a dot, and narrower than the distance to the next dot.
inline constexpr int kShadePart = 5;
/// Distances from a place at which graphics are searched, in 1/60 spacings, along the axes and
/// diagonally. At these distances, every stroke that touches the dot is found.
inline constexpr int kBeside_60th = 8;
inline constexpr int kBesideDiagonally_60th = 5;
/// Darkness of solid ink, relative to the paper. A shade above the geometric mean of solid ink and
/// a dot counts as graphics. With half or twice the value: 1,992.
inline constexpr int kSolidInk_q8 = 230;
/// Reliability of the bits of a cell, in 1/16, by the number of its places in the image. The
/// reliability of a cell with all four places is 16. Measured on hard frames.
inline constexpr std::array<int, 5> kReliabilityBySeen_q4{0, 6, 8, 10, 16};
/// Reliability, in 1/16, of the bits of a cell with a place under graphics.
inline constexpr int kReliabilityCovered_q4 = 10;
/// Minimum shade next to a place, in fifths of the shade of graphics, at which a cell is near
/// graphics.
inline constexpr int kNearGraphics_5ths = 3;
/// Reliability, in 1/16, of the bits of a cell near graphics. With 3: 1,993; with 14: 1,994.
inline constexpr int kReliabilityNearGraphics_q4 = 7;
/// Minimum darkness, in tenths of a typical dot, at which the darkest place of a cell may be dirt.
inline constexpr int kDark_10ths = 13;
/// Reliability, in 1/16, of the bits of a cell whose darkest place may be dirt.
inline constexpr int kReliabilityDark_q4 = 12;
/// Minimum darkness, in tenths of a typical dot, at which the darkest place of a cell is probably
/// dirt.
inline constexpr int kTooDark_10ths = 16;
/// Reliability, in 1/16, of the bits of a cell whose darkest place is probably dirt.
inline constexpr int kReliabilityTooDark_q4 = 6;
/// Weight, in 1/127, of a bit whose places differ by the darkness of a dot. Weights are limited to
/// 127, which corresponds to two fifths of the darkness of a dot. With 150: 1,994; with 600: 1,992.
inline constexpr int kGain = 300;
/// Maximum light of a cell relative to the middle of the image. Above this light, weights do not
/// increase.
inline constexpr int kMaxLight_q8 = 1024;
/// Minimum darkness of the second darkest place of a cell with two dots: kSecondDot_3rds / 3 of a
/// typical dot and kSecondDot_4ths / 4 of the darkest place of the cell. The image contains two
/// patterns if more than kMaxCrowded_8ths / 8 of the cells have two dots. In hard frames, at most a
/// quarter of the cells had two dots.
inline constexpr int kSecondDot_3rds = 2;
inline constexpr int kSecondDot_4ths = 3;
inline constexpr int kMaxCrowded_8ths = 3;
}  // namespace sample_cells

/// Search for the position that agrees best with all lines (decode/search).
namespace search {
/// Number of rolls of one line that are tried.
inline constexpr int kChoices = 8;
/// Maximum number of runs of lines that are read, and of readings per run, in the second attempt.
/// With half or twice either number: 1,994. The larger values leave a margin for frames with more
/// misread bits.
inline constexpr int kRuns = 24;
inline constexpr int kReadings = 64;
/// Maximum number of runs, and of readings per run, in the first attempt and on devices. None of
/// 2,000 nominal frames and 4 of 2,000 hard frames needed more. These limits bound the time for
/// unreadable frames.
inline constexpr int kRunsBriefly = 3;
inline constexpr int kReadingsBriefly = 8;
}  // namespace search

/// Search for the position by the steps between neighbouring lines (decode/step_search).
namespace step_search {
/// Number of places kept in each of the four secondary sequences. All combinations of these places
/// are compared.
inline constexpr std::size_t kChoices = 3;
}  // namespace step_search

/// The quarter turn of the grid (decode/orientation, decode/bit_lines).
namespace turns {
/// Number of lines per axis that vote on the turn, an even number. The vote of several lines
/// outweighs one misread line.
inline constexpr int kVoters = 4;
/// Number of lines per axis that vote if bits are hard, an odd number.
inline constexpr int kVotersOfBits = 5;
/// The vote ends early when the summed scores of the two reading directions, forwards and
/// backwards, differ by at least this value, which equals 8 bits.
inline constexpr int kLandslide = 8 * 127;
/// Minimum agreement with the mirrored pattern, in fourths of the agreement with the upright
/// pattern, at which the image is mirrored. Lines of random bits have about 60 % of the agreement
/// of lines of the main sequence.
inline constexpr int kMirrored_4ths = 5;
}  // namespace turns

}  // namespace dotpose::core::tuning
