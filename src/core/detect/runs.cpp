#include "core/detect/runs.hpp"

#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/words.hpp"

namespace dotpose::core {
namespace {

constexpr std::size_t kWord_px = sizeof(Word);

/// Returns a word in which the top bit of each byte is set if the pixel is light, that is, not
/// darker than the low threshold. The lower bits are undefined.
Word light_tops(Word pixels, Word half_low) {
    return (pixels >> 1 | kTops) - half_low;
}

bool is_light(Word pixels, Word half_low) {
    return (light_tops(pixels, half_low) & kTops) == kTops;
}

bool is_group_light(const std::uint8_t* pixels, const std::uint8_t* half_low_levels) {
    const Word half_low = word_at(half_low_levels);
    Word tops = kTops;
    for (std::size_t k = 0; k < kGroup_px; k += kWord_px)
        tops &= light_tops(word_at(pixels + k), half_low);
    return tops == kTops;
}

/// Returns the first dark pixel of a row at or after `begin`, or the row end. The search never goes
/// past the row end, because the sentinel after the last threshold makes any pixel there dark.
const std::uint8_t* find_dark(const std::uint8_t* begin, const std::uint8_t* row,
                              const std::uint8_t* half_low_levels) {
    const auto before = static_cast<std::size_t>(begin - row) % kWord_px;
    const std::uint8_t* pixels = begin - before;
    half_low_levels += pixels - row;
    Word word = word_at(pixels) | ((Word{1} << 8 * before) - 1);
    while (is_light(word, word_at(half_low_levels))) {
        pixels += kWord_px;
        half_low_levels += kWord_px;
        if (static_cast<std::size_t>(pixels - row) % kGroup_px == 0) {
            while (is_group_light(pixels, half_low_levels)) {
                pixels += kGroup_px;
                half_low_levels += kGroup_px;
            }
        }
        word = word_at(pixels);
    }
    const unsigned low = 2U * *half_low_levels;
    if (pixels < begin) pixels = begin;
    while (*pixels >= low)
        ++pixels;
    return pixels;
}

/// Sets `run` to the run that begins at `pixel`. Returns the end of the run.
const std::uint8_t* write_run(const std::uint8_t* pixel, const std::uint8_t* row,
                              const AdaptiveThreshold& threshold, Run& run) {
    const std::uint8_t* const row_end = row + whole_width(threshold);
    run.begin = static_cast<std::uint16_t>(pixel - row);
    bool passes_high = false;
    std::uint32_t mass = 0;
    // Sum of weight * (last column - column). Adding the mass so far at each pixel avoids a
    // multiplication.
    std::uint32_t moment = 0;
    const std::uint8_t* tile_end = nullptr;
    do {
        const auto column = static_cast<std::size_t>(pixel - row);
        const unsigned low = 2U * threshold.half_low_levels[column];
        const unsigned high = threshold.high_levels[column];
        tile_end = row + (column / kTileWidth_px + 1) * kTileWidth_px;
        unsigned deepest = 0;
        for (; pixel != tile_end && *pixel < low; ++pixel) {
            const unsigned depth = low - *pixel;
            moment += mass;
            mass += depth;
            if (depth > deepest) deepest = depth;
        }
        if (deepest + high > low) passes_high = true;
    } while (pixel == tile_end && pixel != row_end);
    const auto end = static_cast<std::uint32_t>(pixel - row);
    run.end = static_cast<std::uint16_t>(end);
    run.mass = mass;
    run.sum_x = mass * (end - 1) - moment;
    run.passes_high = passes_high;
    return pixel;
}

}  // namespace

int find_runs(int v, const AdaptiveThreshold& threshold, std::span<Run> runs) {
    const std::uint8_t* const row = kept_row(threshold, v);
    const std::uint8_t* const row_end = row + whole_width(threshold);
    const std::uint8_t* pixel = row;
    std::size_t count = 0;
    for (; count < runs.size(); ++count) {
        pixel = find_dark(pixel, row, threshold.half_low_levels.data());
        if (pixel == row_end) break;
        pixel = write_run(pixel, row, threshold, runs[count]);
    }
    return static_cast<int>(count);
}

}  // namespace dotpose::core
