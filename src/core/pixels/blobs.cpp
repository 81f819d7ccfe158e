#include "core/pixels/blobs.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include "core/fixed.hpp"
#include "core/pixels/light.hpp"

namespace dotpose::core {
namespace {

/// A dot at 60 px spacing with a diameter of 0.35 of it, blurred, has fewer pixels and is less
/// wide.
constexpr int kMaxDotArea_px = 1024;
constexpr int kMaxDotSide_px = 48;
constexpr int kMaxMass = 65535;
/// Of runs that found no room.
constexpr std::int16_t kNoBlob = -1;

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

void close_blob(OpenBlob& blob, const Light& light, DotList list) {
    blob.in_use = false;
    if (!blob.has_core || !blob.is_dot) return;
    const Vec centre_q8{blob.first_u * 256 + mean_q8(blob.sum_x, blob.mass),
                        blob.first_v * 256 + mean_q8(blob.sum_y, blob.mass)};
    if (!is_kept(centre_q8, light, list)) return;
    while (list.count == static_cast<int>(list.dots.size()))
        make_room(light, list);
    if (!is_kept(centre_q8, light, list)) return;
    list.dots[static_cast<std::size_t>(list.count++)] = {
        centre_q8, static_cast<std::uint16_t>(std::min(blob.mass, kMaxMass)), blob.area_px};
}

/// The index of a fresh blob that begins at a pixel; kNoBlob if there are too many already.
std::int16_t open_blob(int u, int v, OpenBlobs& open) {
    const int capacity = static_cast<int>(open.blobs.size());
    for (int tries = 0; open.blobs[static_cast<std::size_t>(open.next_free)].in_use; ++tries) {
        if (tries == capacity) return kNoBlob;
        open.next_free = open.next_free + 1 == capacity ? 0 : open.next_free + 1;
    }
    OpenBlob& blob = open.blobs[static_cast<std::size_t>(open.next_free)];
    blob.sum_x = blob.sum_y = blob.mass = 0;
    blob.area_px = 0;
    blob.has_core = false;
    blob.is_dot = blob.in_use = true;
    blob.first_u = static_cast<std::int16_t>(u);
    blob.first_v = static_cast<std::int16_t>(v);
    return static_cast<std::int16_t>(open.next_free);
}

void add_run(const Run& run, int v, const Light& light, OpenBlob& blob) {
    blob.last_v = static_cast<std::int16_t>(v);
    const int width = run.end - run.begin;
    const int height = v - blob.first_v + 1;
    const bool at_border =
        run.begin == 0 || run.end == light.width_px || v == 0 || v + 1 == light.height_px;
    if (at_border || width > kMaxDotSide_px || height > kMaxDotSide_px ||
        blob.area_px + width > kMaxDotArea_px ||
        magnitude(run.begin - blob.first_u) > kMaxDotSide_px) {
        blob.is_dot = false;
    }
    if (!blob.is_dot) return;
    const std::uint8_t* row = kept_row(light, v);
    std::int32_t mass = 0;
    for (int u = run.begin; u < run.end;) {
        const int tile = u >> light.tile_shift;
        const Levels level = light.levels[static_cast<std::size_t>(tile)];
        const int end = std::min<int>((tile + 1) << light.tile_shift, run.end);
        for (; u < end; ++u) {
            // From the threshold, not from the paper: a pixel that just passes it moves nothing.
            const int weight = level.extent - row[u];
            mass += weight;
            blob.sum_x += weight * (u - blob.first_u);
            blob.has_core |= row[u] < level.core;
        }
    }
    blob.mass += mass;
    blob.sum_y += mass * (v - blob.first_v);
    blob.area_px = static_cast<std::uint16_t>(blob.area_px + width);
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
        blob.area_px = static_cast<std::uint16_t>(blob.area_px + other.area_px);
    }
    blob.has_core |= other.has_core;
    other.in_use = false;
}

/// As many pixels at a time as fit a register, the first in the lowest byte.
using Word = std::conditional_t<sizeof(void*) == 8, std::uint64_t, std::uint32_t>;
static_assert(std::endian::native == std::endian::little);
constexpr Word kTops = static_cast<Word>(0x8080808080808080);

/// The top bit of each byte: whether the pixel is at least as light as an even level.
Word light_pixels(const std::uint8_t* pixels, Word half_level) {
    Word word = 0;
    std::memcpy(&word, __builtin_assume_aligned(pixels, sizeof(Word)), sizeof word);
    return ((word >> 1 | kTops) - half_level) & kTops;
}

/// Stretches of dark pixels, from the chunks of eight pixels that have some.
class RunFinder {
  public:
    explicit RunFinder(std::span<Run> runs) : runs_(runs) {}

    // Not inlined: rare, and in the way of the loop over all chunks.
    [[gnu::noinline]] void take(int u, const std::uint8_t* pixels, Word half_level) {
        if (u != next_u_) close(next_u_);
        next_u_ = u + kSmallestTile_px;
        for (; u < next_u_; u += static_cast<int>(sizeof(Word)), pixels += sizeof(Word)) {
            const Word dark = light_pixels(pixels, half_level) ^ kTops;
            Word changes = dark ^ (dark << 8 | (is_open_ ? 0x80U : 0U));
            for (; changes != 0; changes &= changes - 1) {
                const int at = u + std::countr_zero(changes) / 8;
                if (is_open_) {
                    close(at);
                } else {
                    open(at);
                }
            }
        }
    }
    int finish(int width_px) {
        close(std::min(next_u_, width_px));
        return static_cast<int>(count_);
    }

  private:
    void open(int u) {
        if (count_ == runs_.size()) return;
        runs_[count_].begin = static_cast<std::int16_t>(u);
        is_open_ = true;
    }
    void close(int u) {
        if (is_open_) runs_[count_++].end = static_cast<std::int16_t>(u);
        is_open_ = false;
    }

    std::span<Run> runs_;
    std::size_t count_ = 0;
    int next_u_ = 0;
    bool is_open_ = false;
};

[[gnu::noinline]] int find_runs(int v, const Light& light, std::span<Run> runs) {
    RunFinder finder(runs);
    const auto used = light.half_levels.first(static_cast<std::size_t>(light.width_px + 7) / 8);
    const std::uint8_t* pixels = kept_row(light, v);
    int u = 0;
    for (const std::uint32_t four_levels : used) {
        const Word half_level = static_cast<Word>(std::uint64_t{four_levels} << 32 | four_levels);
        Word all = kTops;
        for (std::size_t k = 0; k < kSmallestTile_px; k += sizeof(Word))
            all &= light_pixels(pixels + k, half_level);
        if (all != kTops) finder.take(u, pixels, half_level);
        pixels += kSmallestTile_px;
        u += kSmallestTile_px;
    }
    return finder.finish(light.width_px);
}

/// Gives each run of the new row the blob of the runs above that it touches (corners count).
void connect(std::span<Run> above, std::span<Run> below, int v, OpenBlobs& open) {
    std::size_t first = 0;
    for (std::size_t r = 0; r < below.size(); ++r) {
        Run& run = below[r];
        run.blob = kNoBlob;
        while (first < above.size() && above[first].end < run.begin)
            ++first;
        for (std::size_t a = first; a < above.size() && above[a].begin <= run.end; ++a) {
            const std::int16_t other = above[a].blob;
            if (run.blob == kNoBlob) run.blob = other;
            if (run.blob == other || other == kNoBlob) continue;
            unite(open.blobs[static_cast<std::size_t>(run.blob)],
                  open.blobs[static_cast<std::size_t>(other)]);
            const auto rename = [&](Run& named) {
                if (named.blob == other) named.blob = run.blob;
            };
            std::for_each(above.begin(), above.end(), rename);
            std::for_each(below.begin(), below.begin() + static_cast<std::ptrdiff_t>(r), rename);
        }
        if (run.blob == kNoBlob) run.blob = open_blob(run.begin, v, open);
    }
}

}  // namespace

void begin_blobs(const Light& light, OpenBlobs& open, DotList list) {
    open.run_count = 0;
    open.next_free = 0;
    for (OpenBlob& blob : open.blobs)
        blob.in_use = false;
    list.count = 0;
    list.kept_within_px = std::max(light.width_px, light.height_px);
}

void grow_blobs(int v, const Light& light, OpenBlobs& open, DotList list) {
    const std::size_t half = open.runs.size() / 2;
    const auto older = open.runs.subspan(open.newest_in_second_half ? half : 0, half);
    open.newest_in_second_half = !open.newest_in_second_half;
    const auto newer = open.runs.subspan(open.newest_in_second_half ? half : 0, half);

    const auto above = older.first(static_cast<std::size_t>(open.run_count));
    open.run_count = find_runs(v, light, newer);
    const auto below = newer.first(static_cast<std::size_t>(open.run_count));
    connect(above, below, v, open);
    for (const Run& run : below) {
        if (run.blob == kNoBlob) continue;
        add_run(run, v, light, open.blobs[static_cast<std::size_t>(run.blob)]);
    }
    for (const Run& run : above) {
        if (run.blob == kNoBlob) continue;
        OpenBlob& blob = open.blobs[static_cast<std::size_t>(run.blob)];
        if (blob.in_use && blob.last_v < v) close_blob(blob, light, list);
    }
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
