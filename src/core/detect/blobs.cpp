#include "core/detect/blobs.hpp"

#include <algorithm>
#include <array>

#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/runs.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {
namespace {

/// Maximum area of a dot, and maximum side of its bounding box. A blurred dot with a diameter of
/// 0.35 spacings fits these limits at a spacing of up to 60 px.
constexpr int kMaxDotArea_px = 1024;
constexpr int kMaxDotSide_px = 48;
constexpr std::uint32_t kMaxMass = 65535;
/// Value of `OpenBlob::last_v` for a blob that was merged into another blob.
constexpr std::uint16_t kNoRow = UINT16_MAX;

/// Returns an upper bound on the distance from the image centre to any dot, along each axis.
int all_within_px(const AdaptiveThreshold& threshold) {
    return std::max(threshold.width_px, threshold.height_px);
}

/// Predicate that is true if a dot is at most `DotList::kept_within_px` from the image centre along
/// each axis.
struct IsKept {
    FixedVec image_centre_q8;
    std::int32_t within_q8;

    IsKept(const AdaptiveThreshold& threshold, const DotList& list)
        : image_centre_q8{(threshold.width_px - 1) * 128, (threshold.height_px - 1) * 128},
          within_q8(list.kept_within_px * 256) {}
    bool operator()(const DetectedDot& dot) const {
        return is_within(dot.centre_q8 - image_centre_q8, within_q8);
    }
};

/// Removes the dots that do not satisfy the predicate. The remaining dots keep their order.
/// Standard libraries unroll std::remove_if, which would add a kilobyte of code on small devices.
template <typename Predicate>
void keep_dots(DotList list, Predicate is_to_keep) {
    DetectedDot* kept = list.dots.data();
    for (const DetectedDot& dot : list.dots.first(static_cast<std::size_t>(list.count))) {
        if (!is_to_keep(dot)) continue;
        if (kept != &dot) *kept = dot;
        ++kept;
    }
    list.count = static_cast<int>(kept - list.dots.data());
}

/// Makes room for dots near the image centre: reduces `kept_within_px`, and removes the dots beyond
/// this distance. Returns false if `kept_within_px` is already 0. This function is not inlined,
/// because it is rarely called and would occupy registers that the caller needs.
[[gnu::noinline]] bool make_room(const AdaptiveThreshold& threshold, DotList list) {
    if (list.kept_within_px == 0) return false;
    list.kept_within_px -= list.kept_within_px / 8 + 1;
    keep_dots(list, IsKept(threshold, list));
    return true;
}

/// Returns sum / mass in units of 1/256, rounded. For the largest blobs, discards the lowest bits
/// to prevent a 32-bit overflow.
std::int32_t mean_q8(std::uint32_t sum, std::uint32_t mass) {
    for (; sum >= 1U << 23; sum /= 2)
        mass /= 2;
    return static_cast<std::int32_t>((sum * 256 + mass / 2) / mass);
}

/// Returns true if a blob is small, is not at the image border, and has a pixel darker than the
/// high threshold. The lower border needs no test: a blob is closed only after the next row has
/// been read, so a blob that reaches the last image row is never closed.
bool may_be_dot(const OpenBlob& blob, const AdaptiveThreshold& threshold) {
    return blob.passes_high && blob.area_px <= kMaxDotArea_px && blob.first_v > 0 &&
           blob.left > 0 && blob.right < threshold.width_px &&
           blob.right - blob.left <= kMaxDotSide_px && blob.last_v - blob.first_v < kMaxDotSide_px;
}

void close_blob(const OpenBlob& blob, const AdaptiveThreshold& threshold, DotList list) {
    if (!may_be_dot(blob, threshold)) return;
    // The sums wrap modulo 2^32, but the differences are exact, because they are small (see
    // OpenBlob).
    const DetectedDot dot{
        {blob.left * 256 + mean_q8(blob.sum_x - blob.mass * blob.left, blob.mass),
         blob.first_v * 256 + mean_q8(blob.sum_y - blob.mass * blob.first_v, blob.mass)},
        static_cast<std::uint16_t>(std::min(blob.mass, kMaxMass)),
        static_cast<std::uint16_t>(blob.area_px)};
    // Until the list is full for the first time, keeps every dot without computing its distance.
    while (list.kept_within_px == all_within_px(threshold) || IsKept(threshold, list)(dot)) {
        if (list.count < static_cast<int>(list.dots.size())) {
            list.dots[static_cast<std::size_t>(list.count++)] = dot;
            return;
        }
        if (!make_room(threshold, list)) return;
    }
}

/// Returns an unused blob, or null if all blobs are in use.
OpenBlob* unused_blob(OpenBlobs& open) {
    OpenBlob* const blob = open.first_unused;
    if (blob != nullptr) {
        open.first_unused = blob->part_of;
        return blob;
    }
    return open.blobs_begun < open.blobs.size() ? &open.blobs[open.blobs_begun++] : nullptr;
}

OpenBlob* open_blob(const Run& run, int v, OpenBlobs& open) {
    OpenBlob* const blob = unused_blob(open);
    if (blob == nullptr) return nullptr;
    blob->sum_x = run.sum_x;
    blob->sum_y = run.mass * static_cast<std::uint32_t>(v);
    blob->mass = run.mass;
    blob->area_px = static_cast<std::uint32_t>(run.end - run.begin);
    blob->left = run.begin;
    blob->right = run.end;
    blob->first_v = blob->last_v = static_cast<std::uint16_t>(v);
    blob->part_of = nullptr;
    blob->passes_high = run.passes_high;
    return blob;
}

void add_run(const Run& run, int v, OpenBlob& blob) {
    blob.sum_x += run.sum_x;
    blob.sum_y += run.mass * static_cast<std::uint32_t>(v);
    blob.mass += run.mass;
    blob.area_px += static_cast<std::uint32_t>(run.end - run.begin);
    blob.left = std::min(blob.left, run.begin);
    blob.right = std::max(blob.right, run.end);
    blob.last_v = static_cast<std::uint16_t>(v);
    blob.passes_high |= run.passes_high;
}

void unite(OpenBlob& blob, OpenBlob& other) {
    blob.sum_x += other.sum_x;
    blob.sum_y += other.sum_y;
    blob.mass += other.mass;
    blob.area_px += other.area_px;
    blob.left = std::min(blob.left, other.left);
    blob.right = std::max(blob.right, other.right);
    blob.first_v = std::min(blob.first_v, other.first_v);
    blob.passes_high |= other.passes_high;
    other.part_of = &blob;
    other.last_v = kNoRow;
}

/// Returns the blob that contains `blob` after all merges, or null if `blob` is null.
OpenBlob* whole(OpenBlob* blob) {
    while (blob != nullptr && blob->part_of != nullptr)
        blob = blob->part_of;
    return blob;
}

/// Ends a row of runs with a sentinel, to the right of all runs.
void end_row(Run& after_last) {
    after_last.begin = after_last.end = UINT16_MAX;
}

/// Adds each run of row `v` to the blob that it touches in the row above. Runs that meet only at a
/// corner also touch (8-connectivity). If a run touches several blobs, merges them. If a run
/// touches no blob, opens a new one.
void connect(const Run* above, std::span<Run> below, int v, OpenBlobs& open) {
    bool some_united = false;
    for (Run& run : below) {
        while (above->end < run.begin)
            ++above;
        if (above->begin > run.end) {
            run.blob = open_blob(run, v, open);
            continue;
        }
        OpenBlob* blob = whole(above->blob);
        for (const Run* touching = above + 1; touching->begin <= run.end; ++touching) {
            OpenBlob* const other = whole(touching->blob);
            if (blob == nullptr) {
                blob = other;
            } else if (other != nullptr && other != blob) {
                unite(*blob, *other);
                some_united = true;
            }
        }
        if (blob != nullptr) {
            add_run(run, v, *blob);
        } else {
            blob = open_blob(run, v, open);
        }
        run.blob = blob;
    }
    if (!some_united) return;
    for (Run& run : below)
        run.blob = whole(run.blob);
}

/// Closes the blobs that do not continue in row `v`. Adds each closed blob that may be a dot to the
/// list. Also frees blobs that were merged into another blob.
void close_blobs(std::span<const Run> above, int v, const AdaptiveThreshold& threshold,
                 OpenBlobs& open, DotList list) {
    for (const Run& run : above) {
        OpenBlob* const blob = run.blob;
        if (blob == nullptr || blob->last_v == v) continue;
        if (blob->part_of == nullptr) close_blob(*blob, threshold, list);
        // Marks the blob as handled, so that the other runs of this blob are skipped.
        blob->last_v = static_cast<std::uint16_t>(v);
        blob->part_of = open.first_unused;
        open.first_unused = blob;
    }
}

/// Returns the upper quartile of a data member over a sample of the blobs. The quartile is typical
/// of dots even if half the blobs are noise, because noise is smaller than dots, and few blobs are
/// larger than dots.
std::int32_t typical(std::span<const DetectedDot> dots, std::uint16_t DetectedDot::*member) {
    constexpr std::size_t kSample = 128;
    const std::size_t step = dots.size() / kSample + 1;
    std::array<std::int32_t, kSample> values;
    std::size_t n = 0;
    for (std::size_t i = 0; i < dots.size(); i += step)
        values[n++] = dots[i].*member;
    return upper_quartile(std::span(values).first(n));
}

}  // namespace

void begin_blobs(const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list) {
    open.run_count = 0;
    open.newest_in_second_half = false;
    end_row(open.runs[0]);
    open.runs_left = open.max_runs;
    open.blobs_begun = 0;
    open.first_unused = nullptr;
    list.count = 0;
    list.kept_within_px = all_within_px(threshold);
}

void grow_blobs(int v, const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list) {
    const std::size_t half = open.runs.size() / 2;
    const auto newest = [&] { return open.runs.subspan(half * open.newest_in_second_half, half); };
    const auto older = newest();
    open.newest_in_second_half = !open.newest_in_second_half;
    const auto newer = newest();

    const auto above = older.first(static_cast<std::size_t>(open.run_count));
    const auto room = newer.first(std::min(half - 1, static_cast<std::size_t>(open.runs_left)));
    open.run_count = find_runs(v, threshold, room);
    open.runs_left -= open.run_count;
    const auto below = newer.first(static_cast<std::size_t>(open.run_count));
    end_row(newer[below.size()]);
    connect(above.data(), below, v, open);
    close_blobs(above, v, threshold, open, list);
}

void sift_dots(const BlobOptions& options, DotList list) {
    const auto found = list.dots.first(static_cast<std::size_t>(list.count));
    const std::int32_t min_mass = typical(found, &DetectedDot::mass) * options.min_mass_q8 / 256;
    const std::int32_t max_area = typical(found, &DetectedDot::area_px) * options.max_area_ratio;
    keep_dots(list, [&](const DetectedDot& dot) {
        return dot.area_px >= options.min_area_px && dot.mass >= min_mass &&
               dot.area_px <= max_area;
    });
}

}  // namespace dotpose::core
