// Prints checksums that change if even a single bit of a pose changes. Locates several sets of
// simulated frames, each with one or more methods. For each set and method, prints a checksum of
// the pixels, a checksum of all integers in the fixes, and the number of located frames.
//
//   dotpose_tables golden [--threads N]
//
// scripts/golden-frames compares the output with accuracy/golden.txt. The checksums exclude
// covariances and residuals, because floating-point results may differ between processors.
#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "../tests/limit_frames.hpp"
#include "dotpose/code_evidence.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr std::uint64_t kGoldenSeed = 2424;

/// The 64-bit FNV-1a hash (Fowler, Noll and Vo).
class Checksum {
  public:
    void add(std::int64_t value) {
        for (int shift = 0; shift < 64; shift += 8) {
            sum_ ^= static_cast<std::uint64_t>(value) >> shift & 255;
            sum_ *= 1099511628211ULL;
        }
    }
    std::uint64_t value() const { return sum_; }

  private:
    std::uint64_t sum_ = 14695981039346656037ULL;
};

void add(Checksum& sum, FixedVec vec) {
    sum.add(vec.x);
    sum.add(vec.y);
}

void add(Checksum& sum, const PlaneFromImage& plane) {
    for (const FixedVec vec :
         {plane.centre_q8, plane.at_centre_q16, plane.du_q24, plane.dv_q24, plane.perspective_q30})
        add(sum, vec);
    sum.add(plane.lens_q40);
}

/// Adds all integers of a fix to the checksum. If the status is not ok, adds only the status and
/// the number of dots.
void add(Checksum& sum, const Fix& fix) {
    sum.add(static_cast<std::int64_t>(fix.status));
    sum.add(fix.dots_seen);
    if (fix.status != Status::ok) return;
    sum.add(static_cast<std::int64_t>(fix.attempt));
    sum.add(static_cast<std::int64_t>(fix.surface));
    for (const std::int64_t value :
         {std::int64_t{fix.cell.x}, std::int64_t{fix.cell.y}, std::int64_t{fix.fraction_x_q16},
          std::int64_t{fix.fraction_y_q16}, std::int64_t{fix.theta_bam},
          std::int64_t{fix.section.u}, std::int64_t{fix.section.v},
          std::int64_t{fix.spacing_px_q16}, std::int64_t{fix.dots_used},
          std::int64_t{fix.bit_errors}, std::int64_t{fix.p_wrong_log2},
          std::int64_t{fix.displacement_q16}})
        sum.add(value);
    add(sum, fix.pattern_from_image);
}

/// Two consecutive frames. Tracking uses the fix of the first frame as the prediction for the
/// second frame. Other methods use only the first frame.
struct FramePair {
    GreyImage image;
    GreyImage next;
    DeviceOptions options;
};

/// A named method of locating a frame.
struct GoldenWay {
    std::string name;
    std::function<Fix(const FramePair&, LargeMemory&)> locate;
};
constexpr std::size_t kMaxWays = 5;

/// A set of frames, each rendered once and located with every method in `ways`.
struct GoldenSet {
    std::uint64_t frames = 0;
    std::function<FramePair(std::uint64_t)> frames_at;
    std::vector<GoldenWay> ways;
};

/// Sums of the checksums of all frames. A sum does not depend on the order in which the frames are
/// processed.
struct GoldenTally {
    struct Fixes {
        std::uint64_t checksum = 0;
        std::uint64_t located = 0;
    };
    std::uint64_t pixels = 0;
    std::array<Fixes, kMaxWays> fixes;  ///< indexed like `GoldenSet::ways`

    GoldenTally& operator+=(const GoldenTally& other) {
        pixels += other.pixels;
        for (std::size_t i = 0; i < kMaxWays; ++i) {
            fixes[i].checksum += other.fixes[i].checksum;
            fixes[i].located += other.fixes[i].located;
        }
        return *this;
    }
};

void add(GoldenTally& tally, const GoldenSet& set, std::uint64_t index) {
    const FramePair frames = set.frames_at(index);
    Checksum pixels;
    pixels.add(static_cast<std::int64_t>(index));
    for (const GreyImage* image : {&frames.image, &frames.next}) {
        for (const std::uint8_t grey : image->pixels)
            pixels.add(grey);
    }
    tally.pixels += pixels.value();
    for (std::size_t i = 0; i < set.ways.size(); ++i) {
        const auto memory = std::make_unique<LargeMemory>();
        const Fix fix = set.ways[i].locate(frames, *memory);
        Checksum sum;
        sum.add(static_cast<std::int64_t>(index));
        add(sum, fix);
        tally.fixes[i].checksum += sum.value();
        tally.fixes[i].located += fix.status == Status::ok ? 1 : 0;
    }
}

/// Returns the shot after the camera has moved by a quarter of a spacing along each axis and turned
/// by 2 degrees.
Shot moved(Shot shot) {
    constexpr double kStep = 0.25;
    constexpr double kTurn_rad = 0.035;
    shot.pose.fraction_x += kStep;
    shot.pose.fraction_y -= kStep;
    shot.pose.theta_rad += kTurn_rad;
    ++shot.seed;
    return shot;
}

std::function<FramePair(std::uint64_t)> frames_of(Preset preset, int width_px, int height_px) {
    Setup setup = setup_of(kGoldenSeed, width_px, height_px);
    setup.preset = preset;
    return [setup](std::uint64_t index) {
        const Shot shot = draw_shot(setup, index);
        return FramePair{render(shot), render(moved(shot)), {}};
    };
}

auto with_effort(Effort effort) {
    return [effort](const FramePair& frames, LargeMemory& memory) {
        DeviceOptions options = frames.options;
        options.effort = effort;
        return Locator(memory, options).locate(frames.image.view());
    };
}

auto tracked(Effort effort) {
    return [effort](const FramePair& frames, LargeMemory& memory) {
        DeviceOptions options = frames.options;
        const Fix fix = Locator(memory, options).locate(frames.image.view());
        options.effort = effort;
        if (fix.status != Status::ok) return fix;
        return Locator(memory, options).locate(frames.next.view(), Prediction::like(fix));
    };
}

Fix in_any_code(const FramePair& frames, LargeMemory& memory) {
    return Locator(memory, frames.options).locate_in_any_code(frames.image.view(), {}).fix;
}

std::vector<GoldenSet> all_sets() {
    std::vector<GoldenSet> sets{
        {200,
         frames_of(Preset::nominal, 188, 120),
         {{"nominal, one attempt", with_effort(Effort::once)},
          {"nominal, as a device", with_effort(Effort::device)},
          {"nominal, tracked", tracked(Effort::once)},
          {"nominal, tracked by a device", tracked(Effort::device)},
          {"nominal, in any code", in_any_code}}},
        {150,
         frames_of(Preset::hard, 188, 120),
         {{"hard, two attempts", with_effort(Effort::twice)},
          {"hard, as a device", with_effort(Effort::device)},
          {"hard, tracked", tracked(Effort::twice)}}},
        {40,
         frames_of(Preset::nominal, 640, 480),
         {{"640 x 480, two attempts", with_effort(Effort::twice)},
          {"640 x 480, tracked", tracked(Effort::once)}}},
    };
    for (const test::Limit& limit : test::all_limits()) {
        const auto frames_at = [limit](std::uint64_t index) {
            const Shot shot = test::shot_at(limit, kGoldenSeed, index);
            return FramePair{test::picture_of(limit, shot), {}, test::options_of(limit)};
        };
        const GoldenWay twice{"limit: " + limit.condition, with_effort(Effort::twice)};
        sets.push_back({3, frames_at, {twice}});
    }
    return sets;
}

}  // namespace

bool golden_table(TableRun& run) {
    run.add_threads();
    if (!run.parse()) return true;
    for (const GoldenSet& set : all_sets()) {
        const auto count = run.count<GoldenTally>(
            set.ways.front().name, set.frames,
            [&set](std::uint64_t index, GoldenTally& tally) { add(tally, set, index); });
        if (!count.is_complete()) return false;
        for (std::size_t i = 0; i < set.ways.size(); ++i) {
            const GoldenTally::Fixes& fixes = count.tally.fixes[i];
            fmt::print("{:016x} {:016x} {} of {} located: {}\n", count.tally.pixels, fixes.checksum,
                       fixes.located, set.frames, set.ways[i].name);
        }
        std::fflush(stdout);
    }
    return true;
}

}  // namespace dotpose::tables
