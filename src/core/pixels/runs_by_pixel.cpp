#include "core/pixels/light.hpp"
#include "core/pixels/runs.hpp"
#include "core/pixels/words.hpp"

namespace dotpose::core {
namespace {

/// Pixels that are looked at together: all have the same levels.
constexpr std::size_t kGroup_px = kSmallestTile_px;

/// Passes over groups of pixels none of which is dark. Returns where the next group begins, `end`
/// at last.
const std::uint8_t* skip_light(const std::uint8_t* pixels, const std::uint8_t* half_extents,
                               const std::uint8_t* end) {
    for (; pixels < end; pixels += kGroup_px, half_extents += kGroup_px) {
        const Word half_extent = word_at(half_extents);
        Word light = kTops;
        for (std::size_t k = 0; k < kGroup_px; k += sizeof(Word))
            light &= (word_at(pixels + k) >> 1 | kTops) - half_extent;
        if (light != kTops) return pixels;
    }
    return end;
}

/// Writes down the runs from a group at `u` that shows some to one that ends light, as far as there
/// is room. Returns where the next run belongs.
Run* write_runs(std::size_t u, const std::uint8_t* row, const Light& light, Run* run,
                const Run* end) {
    const std::uint8_t* const row_end = row + light.width_px;
    const std::uint8_t* next = row + u;
    const std::uint8_t* pixel = next;
    std::uint32_t mass = 0;
    std::uint32_t moment = 0;  // weight times (last - u): counts again for every pixel after it
    const auto begin_run = [&] {
        run->begin = static_cast<std::uint16_t>(pixel - row);
        run->has_core = false;
        mass = moment = 0;
    };
    const auto end_run = [&] {
        const auto run_end = static_cast<std::uint32_t>(pixel - row);
        run->end = static_cast<std::uint16_t>(run_end);
        run->mass = mass;
        run->sum_x = mass * (run_end - 1) - moment;
        return ++run;
    };
    while (*pixel >= 2U * light.half_extents[u])
        ++pixel;
    begin_run();
    bool is_dark = true;
    do {
        const auto column = static_cast<std::size_t>(next - row);
        const unsigned extent = 2U * light.half_extents[column];
        const unsigned core = light.cores[column];
        next += kGroup_px;
        while (true) {
            if (!is_dark) {
                while (pixel != next && *pixel >= extent)
                    ++pixel;
                if (pixel == next) break;
                begin_run();
                is_dark = true;
            }
            unsigned deepest = 0;
            for (; pixel != next && *pixel < extent; ++pixel) {
                const unsigned depth = extent - *pixel;
                moment += mass;
                mass += depth;
                if (depth > deepest) deepest = depth;
            }
            if (deepest + core > extent) run->has_core = true;
            if (pixel == next) break;
            if (end_run() == end) return run;
            is_dark = false;
        }
    } while (is_dark && pixel < row_end);
    return is_dark ? end_run() : run;
}

}  // namespace

int find_runs_by_pixel(int v, const Light& light, std::span<Run> runs) {
    const std::uint8_t* const row = kept_row(light, v);
    const std::uint8_t* const row_end = row + light.width_px;
    const std::uint8_t* const half_extents = light.half_extents.data();
    Run* run = runs.data();
    const Run* const end = run + runs.size();
    std::size_t u = 0;
    while (run != end) {
        const std::uint8_t* const dark = skip_light(row + u, half_extents + u, row_end);
        if (dark == row_end) break;
        run = write_runs(static_cast<std::size_t>(dark - row), row, light, run, end);
        u = (run[-1].end / kGroup_px + 1) * kGroup_px;
    }
    return static_cast<int>(run - runs.data());
}

}  // namespace dotpose::core
