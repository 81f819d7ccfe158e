#include "locate/place_evidence.hpp"

#include <algorithm>

#include "core/decode/exact_lines.hpp"
#include "core/integrity/certainty.hpp"
#include "core/integrity/coded_block.hpp"
#include "core/integrity/known_lines.hpp"
#include "core/integrity/known_places.hpp"
#include "locate/on_sheets.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

/// Returns true if `block` makes the place of the hypothesis certain. `block` contains only the
/// bits of the current frame.
bool is_certain_alone(const PlaceEvidence& evidence, const Hypothesis& hypothesis,
                      const CellsInView& view, const BitBlock& block, const BitsRead& bits,
                      Fix& fix) {
    const auto& [kernels, options, known, earlier, line_scores, others, work] = evidence;
    const Place& place = hypothesis.place;
    const auto confidences = confidences_in(bits);
    if (known.are_all() && !shows_sheet(known, options.code, place, block)) return false;
    const CodedBlock coded(options.code, place, view, block);
    if (passes_hard_bit_test(
            kernels, {coded.axis(Axis::x, confidences[0]), coded.axis(Axis::y, confidences[1])},
            options.code, options.integrity, fix, others)) {
        return true;
    }
    if (known.any() && is_certain_on_sheets(kernels, options, place, block, known, fix))
        return true;
    return is_certain(kernels,
                      evidence_of(kernels, options.code, place, block, confidences, line_scores),
                      options.code, options.integrity, work, fix, others);
}

/// Returns true if `block` and the bits of earlier frames together make the place certain.
/// `grid_from_image` is relative to the image centre.
bool is_certain_together(const PlaceEvidence& evidence, const Place& place,
                         const FloatPlane& grid_from_image, const BitBlock& block, Fix& fix) {
    const auto& [kernels, options, known, earlier, line_scores, others, work] = evidence;
    // There are two possible errors: a wrong match of the grids and a wrong place. The probability
    // of each error must be at most half of the limit for the fix.
    DeviceOptions half = options;
    --half.integrity.max_p_wrong_log2;
    const auto joined = earlier.join(block, grid_from_image);
    if (!joined) return false;
    const BitBlock& all = joined->block;
    const bool is_on_sheet =
        known.any() && is_certain_on_sheets(kernels, half, place, all, known, fix);
    if (!is_on_sheet) {
        if (known.are_all()) return false;
        const auto confidences = compared_with_code(options.code, place, all);
        // The test of the frame alone may have used up the work limit of the attempt.
        WorkLimit own_work(WorkLimit::kOfImage);
        if (!is_certain(kernels,
                        evidence_of(kernels, options.code, place, all, confidences, line_scores),
                        options.code, half.integrity, own_work, fix, others))
            return false;
    }
    fix.p_wrong_log2 = 1 + std::max(fix.p_wrong_log2, joined->p_mismatch_log2);
    fix.frames = joined->frames;
    return true;
}

/// Returns true if, on each axis, at most one bit in kMinBitsPerError of an upright block is wrong.
bool agrees_with_code(CodeVariant code, const Place& place, const BitBlock& upright) {
    const auto [x, y] = compared_with_code(code, place, upright);
    constexpr int kMinBits = tuning::patch_grid::kMinBitsPerError;
    return kMinBits * x.wrong() <= x.bits() && kMinBits * y.wrong() <= y.bits();
}

/// Returns false if no place can agree with the bits along an axis (see `agrees_with_code`). `bits`
/// is the number of these bits. The score of a place is at most the sum of the best scores of all
/// lines.
bool may_agree(const Lines& lines, int bits) {
    constexpr int kWeight = 127;
    int max_score = 0;
    for (const ScoredLine& line : lines.all)
        max_score += line.best.score;
    // Each wrong bit decreases the score by twice its weight.
    constexpr int kMinBits = tuning::patch_grid::kMinBitsPerError;
    return kMinBits * max_score >= (kMinBits - 2) * kWeight * bits;
}

/// Tries all quarter turns, starting with `first_quarters`. Returns the first place found that
/// agrees with the bits.
std::optional<TurnedPlace> find_agreeing_place(const PlaceEvidence& evidence, const BitBlock& block,
                                               int first_quarters) {
    const CodeVariant code = evidence.options.code;
    const int bits = number_of_bits(block.rows);
    for (int i = 0; i < 4; ++i) {
        TurnedPlace found{(first_quarters + i) % 4, {}};
        const BitBlock upright = turned(found.quarters, block);
        const BlockLines lines = score_block(evidence.kernels, upright, evidence.line_scores);
        if (may_agree(lines.columns, bits) && may_agree(lines.rows, bits) &&
            find_place_thoroughly(code, lines, found.place) &&
            agrees_with_code(code, found.place, upright))
            return found;
    }
    return {};
}

}  // namespace

std::optional<TurnedPlace> find_turned_place(const PlaceEvidence& evidence, const BitBlock& block,
                                             PlaceSearch search) {
    const auto& [kernels, options, known, earlier, line_scores, others, work] = evidence;
    TurnedPlace found{likeliest_turn(kernels, block), {}};
    const BitBlock upright = turned(found.quarters, block);
    const bool is_exact = find_place_exactly(options.code, upright, found.place);
    if (known.any() && !(is_exact && shows_sheet(known, options.code, found.place, upright))) {
        if (const auto on_sheet = find_place_on_sheets(kernels, options, block, known))
            return TurnedPlace{on_sheet->quarters, on_sheet->place};
        if (known.are_all()) return {};
    }
    if (is_exact) return found;
    const bool is_found =
        find_place(options.code, score_block(kernels, upright, line_scores), found.place);
    if (search == PlaceSearch::thorough &&
        !(is_found && agrees_with_code(options.code, found.place, upright))) {
        if (const auto agreeing = find_agreeing_place(evidence, block, found.quarters))
            return agreeing;
    }
    return is_found ? std::optional(found) : std::nullopt;
}

bool join_earlier(const FloatPlane& grid_from_image, FloatVec from_centre, EarlierBits& earlier,
                  BitBlock& block) {
    if (!earlier.is_in_series()) return true;
    const FloatPlane grid = recentred(grid_from_image, {-from_centre.x, -from_centre.y});
    if (!earlier.is_joining) {
        earlier.note(block, grid, false);
        return true;
    }
    const auto joined = earlier.join(block, grid);
    if (joined) block = joined->block;
    return joined.has_value();
}

std::array<Confidence, 2> confidences_in(const BitsRead& bits) {
    return {Confidence::of_hard_bits(bits.read, bits.wrong_x),
            Confidence::of_hard_bits(bits.read, bits.wrong_y)};
}

bool confirm_place(const PlaceEvidence& evidence, const Hypothesis& hypothesis,
                   const CellsInView& view, const BitBlock& block, const BitsRead& bits, Fix& fix) {
    EarlierBits& earlier = evidence.earlier;
    const Place& place = hypothesis.place;
    bool is_certain = is_certain_alone(evidence, hypothesis, view, block, bits, fix);
    if (earlier.is_in_series()) {
        const FloatPlane grid = centred_plane(hypothesis);
        is_certain = is_certain ||
                     (earlier.is_joining && is_certain_together(evidence, place, grid, block, fix));
        earlier.note(block, grid, is_certain);
    }
    return is_certain;
}

}  // namespace dotpose::core
