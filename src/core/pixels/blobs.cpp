#include "core/pixels/blobs.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "core/fixed.hpp"
#include "core/pixels/light.hpp"
#include "core/pixels/words.hpp"

namespace dotpose::core {
namespace {

/// A dot at 60 px spacing with a diameter of 0.35 of it, blurred, has fewer pixels and is less
/// wide.
constexpr int kMaxDotArea_px = 1024;
constexpr int kMaxDotSide_px = 48;
constexpr int kMaxMass = 65535;

bool is_kept(Vec dot_q8, const Light& light, const DotList& list) {
    const Vec image_centre_q8{(light.width_px - 1) * 128, (light.height_px - 1) * 128};
    return larger_component(dot_q8 - image_centre_q8) <= list.kept_within_px * 256;
}

/// Gives up the outer dots, and all that will follow there, so that the inner ones find room.
void make_room(const Light& light, DotList list) {
    list.kept_within_px -= list.kept_within_px / 8 + 1;
    const auto found = list.dots.first(static_cast<std::size_t>(list.count));
    const auto end = std::remove_if(found.begin(), found.end(), [&](const Dot& dot) {
        return !is_kept(dot.centre_q8, light, list);
    });
    list.count = static_cast<int>(end - found.begin());
}

/// sum / mass in 1/256, rounded: 32 bits are enough for all but the largest blobs, which are cut by
/// a bit or two.
std::int32_t mean_q8(std::int32_t sum, std::int32_t mass) {
    const bool is_negative = sum < 0;
    auto n = static_cast<std::uint32_t>(is_negative ? -sum : sum);
    auto d = static_cast<std::uint32_t>(mass);
    for (; n >= 1U << 23; n /= 2)
        d /= 2;
    const auto mean = static_cast<std::int32_t>((n * 256 + d / 2) / d);
    return is_negative ? -mean : mean;
}

void close_blob(const OpenBlob& blob, const Light& light, DotList list) {
    if (!blob.has_core || !blob.is_dot) return;
    const Vec centre_q8{blob.first_u * 256 + mean_q8(blob.sum_x, blob.mass),
                        blob.first_v * 256 + mean_q8(blob.sum_y, blob.mass)};
    while (is_kept(centre_q8, light, list)) {
        if (list.count < static_cast<int>(list.dots.size())) {
            list.dots[static_cast<std::size_t>(list.count++)] = {
                centre_q8, static_cast<std::uint16_t>(std::min(blob.mass, kMaxMass)),
                static_cast<std::uint16_t>(blob.area_px)};
            return;
        }
        make_room(light, list);
    }
}

/// A fresh blob that begins at a pixel; none if there are too many already.
OpenBlob* open_blob(int u, int v, OpenBlobs& open) {
    OpenBlob* blob = open.first_unused;
    if (blob != nullptr) {
        open.first_unused = blob->part_of;
    } else {
        if (open.blobs_begun == open.blobs.size()) return nullptr;
        blob = &open.blobs[open.blobs_begun++];
    }
    // One by one: the libraries of small devices clear byte by byte.
    blob->sum_x = blob->sum_y = blob->mass = blob->area_px = 0;
    blob->first_u = u;
    blob->first_v = v;
    blob->part_of = nullptr;
    blob->has_core = false;
    blob->is_dot = blob->in_use = true;
    return blob;
}

/// Adds the pixels of a run, which lie in the blob's reach.
void add_pixels(const std::uint8_t* row, const Run& run, int v, const Light& light,
                OpenBlob& blob) {
    std::int32_t mass = 0;
    std::int32_t moment =
        0;  // weight times (u - begin): each counts once for every pixel before it
    for (int end = run.end; end > run.begin;) {
        const int tile = (end - 1) >> light.tile_shift;
        const int begin = std::max<int>(tile << light.tile_shift, run.begin);
        const Levels& level = light.levels[static_cast<std::size_t>(tile)];
        const int extent = level.extent;
        int darkest = extent;
        const std::uint8_t* pixel = row + end;
        do {
            const int grey = *--pixel;
            moment += mass;
            // From the threshold, not from the paper: a pixel that just passes it moves nothing.
            mass += extent - grey;
            if (grey < darkest) darkest = grey;
        } while (pixel != row + begin);
        if (darkest < level.core) blob.has_core = true;
        end = begin;
    }
    blob.mass += mass;
    blob.sum_x += moment + mass * (run.begin - blob.first_u);
    blob.sum_y += mass * (v - blob.first_v);
    blob.area_px += run.end - run.begin;
}

/// Adds `other` to `blob`; both belong to the same dark spot after all.
void unite(OpenBlob& blob, OpenBlob& other) {
    const int du = other.first_u - blob.first_u;
    const int dv = other.first_v - blob.first_v;
    blob.is_dot &= other.is_dot && magnitude(du) <= kMaxDotSide_px &&
                   blob.area_px + other.area_px <= kMaxDotArea_px;
    if (blob.is_dot) {
        blob.sum_x += other.sum_x + du * other.mass;
        blob.sum_y += other.sum_y + dv * other.mass;
        blob.mass += other.mass;
        blob.area_px += other.area_px;
    }
    blob.has_core |= other.has_core;
    other.part_of = &blob;
}

/// Passes over pixels, eight at a time, none of which is darker than their even level; of that,
/// each byte of `half_level` holds half. Returns where the next eight begin, `end` at last.
// Not inlined: small devices have registers for one loop.
[[gnu::noinline]] const std::uint8_t* skip_light(const std::uint8_t* pixels, const Word* half_level,
                                                 const std::uint8_t* end) {
    for (; pixels < end; pixels += kSmallestTile_px, ++half_level) {
        Word light = kTops;
        for (std::size_t k = 0; k < kSmallestTile_px; k += sizeof(Word))
            light &= (word_at(pixels + k) >> 1 | kTops) - *half_level;
        if (light != kTops) return pixels;
    }
    return end;
}

/// Writes down the runs from eight pixels at `u` that show some to eight that end light, as far as
/// there is room. Returns where the next run belongs.
[[gnu::noinline]] Run* write_runs(std::size_t u, const std::uint8_t* row, const Light& light,
                                  Run* run, const Run* end) {
    const Word* half_level = light.half_levels.data() + u / kSmallestTile_px;
    const std::uint8_t* const row_end = row + light.width_px;
    const std::uint8_t* pixel = row + u;
    bool is_dark = false;
    do {
        const auto extent = static_cast<unsigned>(2 * (*half_level++ & 0xFF));
        const std::uint8_t* const next = pixel + kSmallestTile_px;
        while (true) {
            if (is_dark) {
                while (pixel != next && *pixel < extent)
                    ++pixel;
                if (pixel == next) break;
                run++->end = static_cast<int>(pixel - row);
                if (run == end) return run;
            } else {
                while (pixel != next && *pixel >= extent)
                    ++pixel;
                if (pixel == next) break;
                run->begin = static_cast<int>(pixel - row);
            }
            is_dark = !is_dark;
        }
    } while (is_dark && pixel < row_end);
    if (is_dark) run++->end = light.width_px;
    return run;
}

/// Finds the stretches of dark pixels in a row; returns how many.
int find_runs(int v, const Light& light, std::span<Run> runs) {
    const std::uint8_t* const row = kept_row(light, v);
    const std::uint8_t* const row_end = row + light.width_px;
    const Word* const half_levels = light.half_levels.data();
    Run* run = runs.data();
    const Run* const end = run + runs.size();
    std::size_t u = 0;
    while (run != end) {
        const std::uint8_t* dark = skip_light(row + u, half_levels + u / kSmallestTile_px, row_end);
        if (dark == row_end) break;
        run = write_runs(static_cast<std::size_t>(dark - row), row, light, run, end);
        u = (static_cast<std::size_t>(run[-1].end) / kSmallestTile_px + 1) * kSmallestTile_px;
    }
    // Rows are filled up to whole tiles.
    if (run != runs.data()) run[-1].end = std::min(run[-1].end, light.width_px);
    return static_cast<int>(run - runs.data());
}

/// The blob that a run belongs to.
OpenBlob* whole(OpenBlob* blob) {
    while (blob != nullptr && blob->part_of != nullptr)
        blob = blob->part_of;
    return blob;
}

/// Gives each run of the new row the blob of the runs above that it touches (corners count).
void connect(std::span<const Run> above, std::span<Run> below, int v, OpenBlobs& open) {
    auto first = above.begin();
    for (Run& run : below) {
        run.blob = nullptr;
        while (first != above.end() && first->end < run.begin)
            ++first;
        for (auto touching = first; touching != above.end() && touching->begin <= run.end;
             ++touching) {
            OpenBlob* const blob = whole(touching->blob);
            if (run.blob == nullptr) {
                run.blob = blob;
            } else if (blob != nullptr && blob != run.blob) {
                unite(*run.blob, *blob);
            }
        }
        if (run.blob == nullptr) run.blob = open_blob(run.begin, v, open);
    }
}

/// Adds each run of row `v` to its blob.
void add_runs(std::span<Run> runs, int v, const Light& light) {
    const std::uint8_t* row = kept_row(light, v);
    const bool is_rim = v == 0 || v + 1 == light.height_px;
    for (Run& run : runs) {
        run.blob = whole(run.blob);
        if (run.blob == nullptr) continue;
        OpenBlob& blob = *run.blob;
        blob.last_v = v;
        if (!blob.is_dot) continue;
        const int width = run.end - run.begin;
        blob.is_dot = !is_rim && run.begin != 0 && run.end != light.width_px &&
                      width <= kMaxDotSide_px && v - blob.first_v < kMaxDotSide_px &&
                      blob.area_px + width <= kMaxDotArea_px &&
                      magnitude(run.begin - blob.first_u) <= kMaxDotSide_px;
        if (blob.is_dot) add_pixels(row, run, v, light, blob);
    }
}

/// Ends the blobs of the row above that row `v` does not go on with.
void close_blobs(std::span<const Run> above, int v, const Light& light, OpenBlobs& open,
                 DotList list) {
    for (const Run& run : above) {
        OpenBlob* const blob = run.blob;
        if (blob == nullptr || !blob->in_use) continue;
        if (blob->part_of == nullptr) {
            if (blob->last_v == v) continue;
            close_blob(*blob, light, list);
        }
        blob->in_use = false;
        blob->part_of = open.first_unused;
        open.first_unused = blob;
    }
}

}  // namespace

void begin_blobs(const Light& light, OpenBlobs& open, DotList list) {
    open.run_count = 0;
    open.runs_left = open.most_runs;
    open.blobs_begun = 0;
    open.first_unused = nullptr;
    list.count = 0;
    list.kept_within_px = std::max(light.width_px, light.height_px);
}

void grow_blobs(int v, const Light& light, OpenBlobs& open, DotList list) {
    const std::size_t half = open.runs.size() / 2;
    const auto older = open.runs.subspan(open.newest_in_second_half ? half : 0, half);
    open.newest_in_second_half = !open.newest_in_second_half;
    const auto newer = open.runs.subspan(open.newest_in_second_half ? half : 0, half);

    const auto above = older.first(static_cast<std::size_t>(open.run_count));
    const auto room = newer.first(std::min(half, static_cast<std::size_t>(open.runs_left)));
    open.run_count = find_runs(v, light, room);
    open.runs_left -= open.run_count;
    const auto below = newer.first(static_cast<std::size_t>(open.run_count));
    connect(above, below, v, open);
    add_runs(below, v, light);
    close_blobs(above, v, light, open, list);
}

void sift_dots(const BlobOptions& options, DotList list) {
    constexpr std::size_t kSample = 256;
    const std::size_t step = static_cast<std::size_t>(list.count) / kSample + 1;
    // Blobs of noise may be as many as dots; hardly anything is larger.
    const auto typical = [&](auto member) {
        std::array<std::int32_t, kSample> values;
        std::size_t n = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(list.count); i += step)
            values[n++] = list.dots[i].*member;
        return upper_quartile(std::span(values).first(n));
    };
    const std::int32_t min_mass = typical(&Dot::mass) * options.min_mass_q8 / 256;
    const std::int32_t max_area = typical(&Dot::area_px) * options.max_area_ratio;
    const auto found = list.dots.first(static_cast<std::size_t>(list.count));
    const auto end = std::remove_if(found.begin(), found.end(), [&](const Dot& dot) {
        return dot.area_px < options.min_area_px || dot.mass < min_mass || dot.area_px > max_area;
    });
    list.count = static_cast<int>(end - found.begin());
}

}  // namespace dotpose::core
