// Computes the relative poses and print scales of sheets from frames that show two or more of the
// sheets.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "calibrate/sheet_graph.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;

/// Converts a pose from the coordinate frame of the fixed sheet (y down, angles clockwise) to the
/// world frame (y up, angles counter-clockwise).
WorldPose world_of(const PlanePose& pose, const WorldPose& fixed) {
    const double c = std::cos(fixed.yaw_rad);
    const double s = std::sin(fixed.yaw_rad);
    const double right_m = pose.x / 1000;
    const double up_m = -pose.y / 1000;
    return {fixed.x_m + c * right_m - s * up_m, fixed.y_m + s * right_m + c * up_m,
            std::remainder(fixed.yaw_rad - pose.turn, 2 * std::numbers::pi)};
}

/// Returns the views of all frames, ordered by frame.
std::vector<SheetView> views_of(int frames, const FrameAt& frame_at,
                                const std::vector<SheetEntry>& sheets,
                                const std::optional<Camera>& camera,
                                const CalibrateOptions& options, Stitching& result) {
    SeamLocator locator(sheets, camera);
    std::vector<SheetView> all;
    for (int i = 0; i < frames; ++i) {
        std::vector<SheetView> views = locator.views(frame_at(i));
        if (views.size() > 1) ++result.used;
        for (SheetView& view : views) {
            view.frame = i;
            all.push_back(std::move(view));
        }
        if (options.progress && !options.progress(i + 1, frames)) {
            throw Error("stopped; nothing was written");
        }
    }
    return all;
}

/// For each frame, compares each view with the view that contains the most dots.
void describe_seams(const std::vector<SheetView>& views, const SheetGraph& graph,
                    Stitching& result) {
    struct Sums {
        int frames = 0;
        double mm2 = 0;
        double rad2 = 0;
    };
    std::map<std::pair<std::size_t, std::size_t>, Sums> seams;
    for (auto first = views.begin(); first != views.end();) {
        const auto last = std::find_if(
            first, views.end(), [&](const SheetView& view) { return view.frame != first->frame; });
        const auto best = std::max_element(first, last, [](const auto& a, const auto& b) {
            return a.dots.size() < b.dots.size();
        });
        for (; first != last; ++first) {
            if (first == best || !graph.is_connected(first->sheet)) continue;
            // Orders the two sheets by index, so that (a, b) and (b, a) are counted as the same
            // pair.
            const bool is_lower = first->sheet < best->sheet;
            const SheetView& a = is_lower ? *first : *best;
            const SheetView& b = is_lower ? *best : *first;
            const PlanePose by_a = graph.image_centre(a);
            const PlanePose by_b = graph.image_centre(b);
            const double turn = std::remainder(by_a.turn - by_b.turn, 2 * std::numbers::pi);
            Sums& sums = seams[{a.sheet, b.sheet}];
            ++sums.frames;
            sums.mm2 += (std::pow(by_a.x - by_b.x, 2) + std::pow(by_a.y - by_b.y, 2)) / 2;
            sums.rad2 += turn * turn;
            const Eigen::Vector2d on_a = graph.centre_on_sheet(a);
            const Eigen::Vector2d on_b = graph.centre_on_sheet(b);
            result.measurements.push_back(
                {a.sheet, b.sheet, on_a.x(), on_a.y(), on_b.x(), on_b.y()});
        }
    }
    for (const auto& [pair, sums] : seams) {
        result.seams.push_back({result.sheets[pair.first].name, result.sheets[pair.second].name,
                                sums.frames, std::sqrt(sums.mm2 / sums.frames),
                                std::sqrt(sums.rad2 / sums.frames)});
    }
}

/// Returns the index of the fixed sheet. A sheet is a candidate if at least one frame shows it
/// together with another sheet. The fixed sheet is the first candidate with a world pose, or the
/// first candidate if no sheet has a world pose. Throws Error if there are sheets with a world
/// pose, but none of them is a candidate.
std::size_t fixed_sheet(const std::vector<SheetEntry>& sheets,
                        const std::vector<SheetView>& views) {
    std::set<std::size_t> joined;
    for (std::size_t i = 1; i < views.size(); ++i) {
        if (views[i].frame == views[i - 1].frame)
            joined.insert({views[i].sheet, views[i - 1].sheet});
    }
    const auto has_world_pose = [&](std::size_t i) { return sheets[i].world.has_value(); };
    const auto fixed = std::ranges::find_if(joined, has_world_pose);
    if (fixed != joined.end()) return *fixed;
    for (const SheetEntry& entry : sheets) {
        if (!entry.world) continue;
        throw Error(
            fmt::format("no frame shows '{}', which has a world pose, beside another sheet: take "
                        "frames over its seams",
                        entry.name));
    }
    return *joined.begin();
}

void require_reference(const ScaleReference& reference, const std::vector<SheetEntry>& sheets,
                       const std::optional<Camera>& camera) {
    using By = ScaleReference::By;
    if (reference.by == By::camera && !(camera && camera->paper)) {
        throw BadArgument(
            "the camera cannot define the scale: its file has no mm_per_px, unlike that of a "
            "mounted camera");
    }
    if (reference.by != By::width) return;
    if (std::ranges::find(sheets, reference.sheet, &SheetEntry::name) == sheets.end()) {
        throw BadArgument(
            fmt::format("there is no sheet '{}' to define the scale", reference.sheet));
    }
    if (!(reference.width_mm > 0 && std::isfinite(reference.width_mm))) {
        throw BadArgument("the true width of a sheet must be above 0");
    }
}

/// Throws Error if the mean print scale deviates from 1 by more than the error of any printer. In
/// this case, the view in the camera file or the spacing in the sheet file is wrong.
void require_plausible(const AxisScale& scale, const SheetEntry& entry) {
    constexpr double kMaxScaleError = 0.25;
    const double mean = std::sqrt(scale.x * scale.y);
    if (std::abs(mean - 1) <= kMaxScaleError) return;
    const double spacing_mm = entry.sheet.pattern.spacing_mm;
    throw Error(
        fmt::format("the camera file measures a spacing of {:.3f} mm on '{}', and the sheet file "
                    "has {:g} mm: correct the spacing, or calibrate the lens again; nothing was "
                    "written",
                    mean * spacing_mm, entry.name, spacing_mm));
}

void describe_sheets(const SheetGraph& graph, std::size_t fixed, Stitching& result) {
    const WorldPose origin = result.sheets[fixed].world.value_or(WorldPose{});
    for (std::size_t i = 0; i < result.sheets.size(); ++i) {
        SheetEntry& entry = result.sheets[i];
        if (!graph.is_connected(i)) {
            if (result.reference.by == ScaleReference::By::width &&
                entry.name == result.reference.sheet) {
                throw Error(fmt::format(
                    "no frame connects '{}', which defines the scale, to the other sheets",
                    entry.name));
            }
            result.unconnected.push_back(entry.name);
            continue;
        }
        entry.world = i == fixed ? origin : world_of(graph.pose(i), origin);
        const AxisScale scale = graph.print_scale(i);
        const AxisScale sigma = graph.sigma_scale(i);
        entry.print_scale_x = scale.x;
        entry.print_scale_y = scale.y;
        result.stitched.push_back(
            {entry.name, graph.sigma_mm(i), graph.sigma_rad(i), i == fixed, sigma.x, sigma.y});
        if (result.reference.by == ScaleReference::By::camera) require_plausible(scale, entry);
    }
}

}  // namespace

Stitching stitch_sheets(int frames, const FrameAt& frame_at, std::vector<SheetEntry> sheets,
                        const std::optional<Camera>& camera, const CalibrateOptions& options,
                        const ScaleReference& reference) {
    if (sheets.size() < 2) {
        throw Error(fmt::format("stitching needs a sheet file with at least two sheets, not {}",
                                sheets.size()));
    }
    require_reference(reference, sheets, camera);
    Stitching result;
    result.frames = frames;
    result.reference = reference;
    const auto views = views_of(frames, frame_at, sheets, camera, options, result);
    if (result.used == 0) {
        throw Error(fmt::format(
            "none of the {} frames shows two sheets of the sheet file: drive over the seams, and "
            "make sure that each sheet fills a third of the image and shows 8 x 8 dots",
            frames));
    }
    const std::size_t fixed = fixed_sheet(sheets, views);
    SheetGraph graph(sheets, camera, views, fixed, reference);
    graph.solve();
    result.sheets = sheets;
    describe_sheets(graph, fixed, result);
    describe_seams(views, graph, result);
    return result;
}

}  // namespace dotpose
