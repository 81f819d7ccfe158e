// Tuning: numbers of finding the position that were found by trying rather than derived, on the
// frames of `dotpose evaluate --preset hard --frames 4000 --seed 404`, on 3,000 with `--seed 5001`,
// and on the refused ones of seeds 777 and 778; docs/accuracy.md shows that they suit others. Where
// a comment says what other values do, it gives frames located by `dotpose evaluate --preset hard
// --frames 2000 --seed 404`: 1,994 with the values as they are, and none wrong with any. One frame
// more or less is chance.
#pragma once

#include <array>
#include <cstddef>

namespace dotpose::core::tuning {

/// Bits from the darkness at a cell's four places (decode/sample_cells).
namespace sample_cells {
/// Most cells whose median is taken for a typical dot; a quarter of them under graphics hardly
/// moves it.
inline constexpr std::size_t kMedianSample = 256;
/// Part of the spacing that is half the side of the square for a place's shade: the square is wider
/// than a dot and narrower than the way to the next one.
inline constexpr int kShadePart = 5;
/// How far from a place graphics are looked for, in 1/60 spacings, along the axes and diagonally; a
/// stroke that touches the dot from either side is seen.
inline constexpr int kBeside_60th = 8;
inline constexpr int kBesideDiagonally_60th = 5;
/// Darkness of solid ink, relative to the paper. A shade beyond the geometric mean of this and a
/// dot's is graphics. With half or twice this value: 1,992.
inline constexpr int kSolidInk_q8 = 230;
/// Trust in a cell's bits, in 1/16, by how many of its places are seen; in hard frames bits were
/// this much less sure than those of cells in plain view.
inline constexpr std::array<int, 5> kTrustBySeen_q4{0, 6, 8, 10, 16};
/// Trust in the bits of a cell that graphics cover a place of.
inline constexpr int kTrustCovered_q4 = 10;
/// Trust in the bits of a cell whose darkest shade beside a place is more than so many fifths of
/// that of graphics. With a trust of 3: 1,993; with 14: 1,994.
inline constexpr int kNearGraphics_5ths = 3;
inline constexpr int kTrustNearGraphics_q4 = 7;
/// Trust in the bits of a cell whose darkest place is more than so many tenths as dark as a typical
/// dot: it may be dirt.
inline constexpr int kDark_10ths = 13;
inline constexpr int kTrustDark_q4 = 12;
inline constexpr int kTooDark_10ths = 16;
inline constexpr int kTrustTooDark_q4 = 6;
/// Weight, in 1/127, of a bit whose places differ by the darkness of a dot; weights are then
/// limited to 127, so from two fifths of that difference on a bit gets no surer. With 150: 1,994;
/// with 600: 1,992.
inline constexpr int kGain = 300;
/// Light of a cell, over that at the middle of the image, beyond which a bit gets no surer.
inline constexpr int kMostLight_q8 = 1024;
/// A cell shows two dots if its second darkest place is darker than so many thirds of a typical dot
/// and so many fourths of the darkest place. The image shows two patterns if more than so many
/// eighths of the cells show two dots; in hard frames at most a quarter did.
inline constexpr int kSecondDot_3rds = 2;
inline constexpr int kSecondDot_4ths = 3;
inline constexpr int kMostCrowded_8ths = 3;
}  // namespace sample_cells

/// The position that all lines speak for (decode/search).
namespace search {
/// Rolls of one line that are tried.
inline constexpr int kChoices = 8;
/// Runs of lines that are read, and readings of each, in the second attempt. With half or twice as
/// many of either: 1,994; they protect frames with more misread bits than these have.
inline constexpr int kRuns = 24;
inline constexpr int kReadings = 64;
/// Runs and readings in the first attempt and on devices. Of 2,000 nominal frames none needed more,
/// and of 2,000 hard ones 4; frames that cannot be read take hardly longer than others.
inline constexpr int kRunsBriefly = 3;
inline constexpr int kReadingsBriefly = 8;
}  // namespace search

/// The position from the steps between neighbouring lines (decode/step_search).
namespace step_search {
/// Places kept of each of the four secondary sequences; all their combinations are compared.
inline constexpr std::size_t kChoices = 3;
}  // namespace step_search

/// Which way is up (decode/orientation, decode/bit_lines).
namespace turns {
/// Lines of each axis that vote on the turn; an even number. Several protect from a turn that
/// misread lines vote for.
inline constexpr int kVoters = 4;
/// Lines of each axis that vote if their bits are hard; an odd number.
inline constexpr int kVotersOfBits = 5;
/// Difference between the scores of both directions from which the others of these need not vote:
/// 8 bits; a line of 14 makes about 5.
inline constexpr int kLandslide = 8 * 127;
/// How much better, in fourths, a mirror image has to agree for the sheet to be seen from behind;
/// lines of random bits reach about 60 % of the agreement of lines of the main sequence.
inline constexpr int kMirrored_4ths = 5;
}  // namespace turns

}  // namespace dotpose::core::tuning
