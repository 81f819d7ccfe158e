#include "core/pixels/blobs.hpp"

#include <algorithm>
#include <array>

#include "core/fixed.hpp"
#include "core/pixels/light.hpp"

namespace dotpose::core {
namespace {

/// A dot at 60 px spacing with a diameter of 0.35 of it, blurred, has fewer pixels and is less
/// wide.
constexpr int kMaxDotArea_px = 1024;
constexpr int kMaxDotSide_px = 48;
constexpr int kMaxMass = 65535;

/// Gives up the outer dots, and all that will follow there, so that the inner ones find room.
void make_room(const Light& light, DotList list) {
    list.kept_within_px -= list.kept_within_px / 8 + 1;
    const Vec centre_q8{(light.width_px - 1) * 128, (light.height_px - 1) * 128};
    const std::int32_t reach_q8 = list.kept_within_px * 256;
    const auto found = list.dots.first(static_cast<std::size_t>(list.count));
    const auto end = std::remove_if(found.begin(), found.end(), [&](const Dot& dot) {
        const Vec d = dot.centre_q8 - centre_q8;
        return std::max(std::max(d.x, -d.x), std::max(d.y, -d.y)) > reach_q8;
    });
    list.count = static_cast<int>(end - found.begin());
}

bool is_kept(Vec centre_q8, const Light& light, const DotList& list) {
    const std::int32_t dx = centre_q8.x - (light.width_px - 1) * 128;
    const std::int32_t dy = centre_q8.y - (light.height_px - 1) * 128;
    const std::int32_t reach_q8 = list.kept_within_px * 256;
    return std::max(dx, -dx) <= reach_q8 && std::max(dy, -dy) <= reach_q8;
}

void close_blob(OpenBlob& blob, const Light& light, DotList list) {
    blob.in_use = false;
    if (!blob.has_core || !blob.is_dot) return;
    const auto centre = [&](int first, std::int32_t sum) {
        return first * 256 + static_cast<std::int32_t>(divide_rounded(sum * 256LL, blob.mass));
    };
    const Vec centre_q8{centre(blob.first_u, blob.sum_x), centre(blob.first_v, blob.sum_y)};
    if (!is_kept(centre_q8, light, list)) return;
    while (list.count == static_cast<int>(list.dots.size()))
        make_room(light, list);
    if (!is_kept(centre_q8, light, list)) return;
    list.dots[static_cast<std::size_t>(list.count++)] = {
        centre_q8, static_cast<std::uint16_t>(std::min(blob.mass, kMaxMass)), blob.area_px};
}

/// The index of a fresh blob that begins at a pixel.
std::int16_t open_blob(int u, int v, OpenBlobs& open) {
    const int capacity = static_cast<int>(open.blobs.size());
    while (open.blobs[static_cast<std::size_t>(open.next_free)].in_use) {
        open.next_free = open.next_free + 1 == capacity ? 0 : open.next_free + 1;
    }
    OpenBlob& blob = open.blobs[static_cast<std::size_t>(open.next_free)];
    blob = OpenBlob{};
    blob.in_use = true;
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
        std::abs(run.begin - blob.first_u) > kMaxDotSide_px) {
        blob.is_dot = false;
    }
    if (!blob.is_dot) return;
    const std::uint8_t* row = kept_row(light, v);
    for (int u = run.begin; u < run.end; ++u) {
        const Levels& level = light.levels[static_cast<std::size_t>(u / light.tile_px)];
        // From the threshold, not from the paper: a pixel that just passes it moves nothing.
        const int weight = level.extent - row[u];
        blob.mass += weight;
        blob.sum_x += weight * (u - blob.first_u);
        blob.sum_y += weight * (v - blob.first_v);
        blob.has_core |= row[u] < level.core;
    }
    blob.area_px = static_cast<std::uint16_t>(blob.area_px + width);
}

/// Adds `other` to `blob`; both belong to the same dark spot after all.
void unite(OpenBlob& blob, OpenBlob& other) {
    const int du = other.first_u - blob.first_u;
    const int dv = other.first_v - blob.first_v;
    blob.is_dot &= other.is_dot && std::abs(du) <= kMaxDotSide_px &&
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

int find_runs(int v, const Light& light, std::span<Run> runs) {
    const std::uint8_t* row = kept_row(light, v);
    int count = 0;
    bool dark_before = false;
    int u = 0;
    for (int tile = 0; tile < light.tiles_per_band; ++tile) {
        const int threshold = light.levels[static_cast<std::size_t>(tile)].extent;
        const int end = std::min(u + light.tile_px, light.width_px);
        for (; u < end; ++u) {
            const bool dark = row[u] < threshold;
            if (dark == dark_before) continue;
            if (dark) {
                runs[static_cast<std::size_t>(count)].begin = static_cast<std::int16_t>(u);
            } else {
                runs[static_cast<std::size_t>(count++)].end = static_cast<std::int16_t>(u);
            }
            dark_before = dark;
        }
    }
    if (dark_before) runs[static_cast<std::size_t>(count++)].end = static_cast<std::int16_t>(u);
    return count;
}

/// Gives each run of the new row the blob of the runs above that it touches (corners count).
void connect(std::span<Run> above, std::span<Run> below, int v, OpenBlobs& open) {
    std::size_t first = 0;
    for (std::size_t r = 0; r < below.size(); ++r) {
        Run& run = below[r];
        run.blob = -1;
        while (first < above.size() && above[first].end < run.begin)
            ++first;
        for (std::size_t a = first; a < above.size() && above[a].begin <= run.end; ++a) {
            const std::int16_t other = above[a].blob;
            if (run.blob < 0) run.blob = other;
            if (run.blob == other) continue;
            unite(open.blobs[static_cast<std::size_t>(run.blob)],
                  open.blobs[static_cast<std::size_t>(other)]);
            const auto rename = [&](Run& named) {
                if (named.blob == other) named.blob = run.blob;
            };
            std::for_each(above.begin(), above.end(), rename);
            std::for_each(below.begin(), below.begin() + static_cast<std::ptrdiff_t>(r), rename);
        }
        if (run.blob < 0) run.blob = open_blob(run.begin, v, open);
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
        add_run(run, v, light, open.blobs[static_cast<std::size_t>(run.blob)]);
    }
    for (const Run& run : above) {
        OpenBlob& blob = open.blobs[static_cast<std::size_t>(run.blob)];
        if (blob.in_use && blob.last_v < v) close_blob(blob, light, list);
    }
}

void sift_dots(const BlobOptions& options, DotList list) {
    constexpr int kSample = 256;
    std::array<std::int32_t, kSample> masses;
    std::array<std::int32_t, kSample> areas;
    const int step = std::max(list.count / kSample, 1);
    std::size_t n = 0;
    for (int i = 0; i < list.count && n < kSample; i += step, ++n) {
        masses[n] = list.dots[static_cast<std::size_t>(i)].mass;
        areas[n] = list.dots[static_cast<std::size_t>(i)].area_px;
    }
    const std::int32_t min_mass = median(std::span(masses).first(n)) * options.min_mass_q8 / 256;
    const std::int32_t max_area = median(std::span(areas).first(n)) * options.max_area_ratio;
    const auto found = list.dots.first(static_cast<std::size_t>(list.count));
    const auto end = std::remove_if(found.begin(), found.end(), [&](const Dot& dot) {
        return dot.area_px < options.min_area_px || dot.mass < min_mass || dot.area_px > max_area;
    });
    list.count = static_cast<int>(end - found.begin());
}

}  // namespace dotpose::core
