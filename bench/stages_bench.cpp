// Benchmarks the individual stages of the pipeline on a nominal frame of 188 x 120 px. Each stage
// starts from the results of the previous stages. docs/pipeline.md describes the stages.
#include <algorithm>
#include <array>
#include <memory>

#include <fmt/core.h>

#include "benchmarks.hpp"
#include "core/decode/likelihood.hpp"
#include "core/decode/lines.hpp"
#include "core/decode/orientation.hpp"
#include "core/decode/position.hpp"
#include "core/decode/search.hpp"
#include "core/decode/window.hpp"
#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/blobs.hpp"
#include "core/integrity/verify.hpp"
#include "core/lattice/axes.hpp"
#include "core/lattice/neighbours.hpp"
#include "core/pose/subgrid.hpp"
#include "device/affine_pose.hpp"
#include "device/grow.hpp"
#include "device/locate.hpp"
#include "device/origin.hpp"
#include "frames.hpp"
#include "locate/workspace.hpp"

namespace dotpose::bench {
namespace {

constexpr DeviceOptions kOptions;
constexpr CodeVariant kCode = kOptions.code;

/// A located frame with the intermediate results of all stages.
struct Located {
    const GreyImage* image = nullptr;
    std::vector<DetectedDot> blobs;  ///< dots before the size filter
    core::SmallWorkspace w;

    std::span<const std::uint16_t> seeds() const { return w.seeds.first(size(w.seed_count)); }
    FixedVec centre_q8() const {
        return {(image->width_px - 1) * 128, (image->height_px - 1) * 128};
    }
    core::DotList dot_list() { return {w.dots, w.dot_count, w.dots_kept_within_px}; }
    core::Upright upright() const {
        return {w.grid, w.decoding.region, w.decoding.pattern_from_grid};
    }
    static std::size_t size(int count) { return static_cast<std::size_t>(count); }
};

/// Type of a function that runs one stage. Returns true if the result is the same as in the
/// pipeline.
using Stage = bool (*)(Located&);

bool measure_light(Located& l) {
    core::AdaptiveThreshold& light = l.w.threshold;
    core::begin_threshold(l.image->width_px, l.image->height_px, light);
    int band = 0;
    for (int v = 0; v < l.image->height_px; ++v) {
        for (int ready = core::take_row(l.image->view().row(v), light); ready > 0; --ready, ++band)
            core::measure_levels(band, kOptions.threshold, light);
    }
    return light.has_contrast;
}

bool push_rows(const GreyImage& image, core::DeviceWorkspace& w) {
    if (core::begin(image.width_px, image.height_px, kOptions, w) != Status::ok) return false;
    for (int v = 0; v < image.height_px; ++v)
        core::push_row(image.view().row(v), kOptions, w);
    return true;
}

bool find_blobs(Located& l) {
    return push_rows(*l.image, l.w) && l.w.dot_count == static_cast<int>(l.blobs.size());
}

bool sift_dots(Located& l) {
    std::ranges::copy(l.blobs, l.w.dots.begin());
    l.w.dot_count = static_cast<int>(l.blobs.size());
    core::sift_dots(kOptions.blobs, l.dot_list());
    return l.w.dot_count == l.w.fix.dots_seen;
}

bool choose_seeds(Located& l) {
    const auto room = l.w.seeds.first(l.seeds().size());
    return core::choose_seeds(l.w.found_dots(), l.centre_q8(), room) == l.w.seed_count;
}

bool connect_neighbours(Located& l) {
    const auto dots = l.w.found_dots();
    core::find_neighbours(dots, l.seeds(), l.w.buckets, l.w.neighbours);
    return core::connect_symmetric(dots, l.seeds(), l.w.neighbours, l.w.edges) == l.w.edge_count;
}

bool estimate_axes(Located& l) {
    const auto edges = l.w.edges.first(Located::size(l.w.edge_count));
    const FixedVec before = l.w.lattice.u_q16;
    return core::estimate_axes(edges, l.w.edge_values, l.w.lattice) == Status::ok &&
           l.w.lattice.u_q16 == before;
}

bool find_origin(Located& l) {
    const FixedVec before = l.w.lattice.origin_q16;
    core::find_origin(l.w.found_dots(), l.seeds(), l.centre_q8(), l.w.lattice);
    return l.w.lattice.origin_q16 == before;
}

bool grow_grid(Located& l) {
    const FixedVec before = l.w.grid_from_image.du_q24;
    const Status status = core::grow_grid(l.w.found_dots(), kOptions.lattice, l.centre_q8(),
                                          l.w.lattice, l.w.grid_from_image);
    return status == Status::ok && l.w.grid_from_image.du_q24 == before;
}

bool assign_likelihoods(Located& l) {
    const int before = l.w.grid.columns;
    const Status status = core::assign_likelihoods(l.w.found_dots(), l.w.grid_from_image, l.w.grid);
    return status == Status::ok && l.w.grid.columns == before;
}

bool choose_windows(Located& l) {
    const GridRegion window = core::choose_window(l.w.grid, kWindowSide);
    const GridRegion region =
        core::choose_window(l.w.grid, static_cast<int>(l.w.line_scores.size() / 2));
    return window.i0 == l.w.decoding.window.i0 && region.i0 == l.w.decoding.region.i0;
}

bool rank_turns(Located& l) {
    const auto turns = core::rank_turns(l.w.grid, l.w.decoding.region).turns;
    const int turn = l.w.decoding.pattern_from_grid.quarters;
    return turns[0].quarters == turn || turns[1].quarters == turn;
}

bool correlate(Located& l) {
    int lines = 0;
    for (const core::Axis axis : {core::Axis::x, core::Axis::y}) {
        const auto storage = core::scores_of(axis, std::span(l.w.line_scores));
        lines += core::score_lines(l.upright(), axis, storage).count();
    }
    return lines == l.w.decoding.region.columns + l.w.decoding.region.rows;
}

bool search(Located& l) {
    for (const core::Axis axis : {core::Axis::x, core::Axis::y}) {
        const auto storage = core::scores_of(axis, std::span(l.w.line_scores));
        const core::Lines lines = core::scored_lines(l.upright(), axis, storage);
        core::AxisReading reading;
        if (core::find_axis_briefly(kCode, lines, reading) != Status::ok) return false;
    }
    return l.w.decoding.lines_are_scored;
}

bool decode(Located& l) {
    const Cell before = l.w.decoding.place.cell;
    const Status status = core::decode_briefly(l.w.grid, kCode, l.w.line_scores, l.w.decoding);
    return status == Status::ok && l.w.decoding.place.cell == before;
}

bool verify_quickly(Located& l) {
    return core::verify_quickly(l.w.grid, kCode, l.w.decoding, kOptions.integrity, l.w.line_scores,
                                l.w.fix) == Status::ok;
}

bool fit_affine_pose(Located& l) {
    const core::Nominal nominal(l.w.grid, kCode, l.w.decoding);
    PlaneFromImage plane = core::upright_plane(l.w.grid_from_image, l.w.decoding.pattern_from_grid);
    const core::Observations observations(l.w.found_dots(), l.w.grid, nominal);
    std::int32_t displacement_q16 = 0;
    const int used = core::fit_affine_pose(observations, plane, displacement_q16);
    core::write_pose(plane, l.centre_q8(), kCode, l.w.decoding.place, l.w.fix);
    return used > 0;
}

struct NamedStage {
    const char* name;
    Stage run;
    bool is_part = false;  ///< true if this stage is part of the `position` stage
};
constexpr std::array kStages = {
    NamedStage{"light", measure_light},
    NamedStage{"blobs", find_blobs},
    NamedStage{"size filter", sift_dots},
    NamedStage{"seeds", choose_seeds},
    NamedStage{"neighbours", connect_neighbours},
    NamedStage{"axes", estimate_axes},
    NamedStage{"origin", find_origin},
    NamedStage{"grow", grow_grid},
    NamedStage{"likelihood", assign_likelihoods},
    NamedStage{"window", choose_windows},
    NamedStage{"position", decode},
    NamedStage{"orientation", rank_turns, true},
    NamedStage{"correlation", correlate, true},
    NamedStage{"search", search, true},
    NamedStage{"verify", verify_quickly},
    NamedStage{"affine pose", fit_affine_pose},
};

std::string name_of(const NamedStage& stage) {
    return fmt::format("stage/{}", stage.name);
}

/// Locates the frame again, and saves a copy of the results that later stages overwrite. Returns
/// false on failure.
bool prepare(const KnownFrame& frame, Located& l) {
    l.image = &frame.image;
    if (!push_rows(frame.image, l.w)) return false;
    l.blobs.assign(l.w.found_dots().begin(), l.w.found_dots().end());
    return is_right(core::finish_as_device(kOptions, l.w), frame.truth);
}

void run_stage(benchmark::State& state, const NamedStage& stage) {
    static std::vector<std::unique_ptr<Located>> all;
    const std::vector<KnownFrame>& frames = nominal_frames({});
    while (all.size() < frames.size())
        all.push_back(std::make_unique<Located>());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (!prepare(frames[i], *all[i]) || !stage.run(*all[i])) {
            return state.SkipWithError("a frame is not located as in the pipeline");
        }
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(stage.run(*all[next]));
        next = (next + 1) % all.size();
    }
}

}  // namespace

void add_stage_benchmarks() {
    for (const NamedStage& stage : kStages) {
        benchmark::RegisterBenchmark(name_of(stage).c_str(), [&stage](benchmark::State& state) {
            run_stage(state, stage);
        })->Unit(benchmark::kMicrosecond);
    }
}

std::string stage_table(const Results& results) {
    std::string table = "| stage | µs |\n|---|--:|\n";
    double all_us = 0;
    for (const NamedStage& stage : kStages) {
        double us = results.of(name_of(stage)).us;
        // The pipeline alternates between blob detection and the update of the adaptive threshold,
        // band by band. The benchmark of blob detection therefore includes both steps, so the time
        // of the threshold update is subtracted.
        if (stage.run == find_blobs) us -= results.of(name_of(kStages.front())).us;
        table +=
            fmt::format("| {} | {}{:.2f} |\n", stage.name, stage.is_part ? "of which " : "", us);
        if (!stage.is_part) all_us += us;
    }
    return table + fmt::format("| **all** | {:.2f} |\n", all_us);
}

}  // namespace dotpose::bench
