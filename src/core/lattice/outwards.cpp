#include "core/lattice/outwards.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/lattice/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::outwards;

/// Returns the pair of plane waves that fits the central dots best. Returns nullopt if the waves
/// are too weak, the spacing is out of range, or there are too few central dots.
std::optional<Waves> find_waves(const Kernels& kernels, const Patch& patch, const PatchView& view) {
    const float spacing = view.spacing_px;
    const PatchDots& dots = patch.dots;
    const auto scale = static_cast<float>(patch.scale);
    if (spacing < tuned::kFinest_px * scale || spacing > tuned::kCoarsest_px * scale) return {};
    // The central dots are in a disc with the area of `central_dots` cells.
    const float radius_2 = view.central_dots * spacing * spacing / 3.14159265F;
    alignas(64) std::array<float, tuned::kMaxCentralDots + 8> x;
    alignas(64) std::array<float, tuned::kMaxCentralDots + 8> y;
    std::size_t count = 0;
    for (std::size_t i = 0;
         i < static_cast<std::size_t>(dots.count) && count < tuned::kMaxCentralDots; ++i) {
        x[count] = dots.x[i];
        y[count] = dots.y[i];
        count += dots.x[i] * dots.x[i] + dots.y[i] * dots.y[i] < radius_2 ? 1 : 0;
    }
    if (count < tuned::kMinCentralDots) return {};
    std::fill_n(x.begin() + count, 8, kNoDot_px);
    std::fill_n(y.begin() + count, 8, 0.0F);
    const float unit = static_cast<float>(count) * static_cast<float>(count);
    if (view.is_skewed) {
        const Waves waves = kernels.strongest_skewed_waves(x.data(), y.data(),
                                                           static_cast<int>(count), 1 / spacing);
        return waves.power < tuned::kFaintWaves * unit ? std::nullopt : std::optional(waves);
    }
    Waves best;
    // Also tries other spacings, because missing dots increase the estimated spacing, and false
    // dots reduce it.
    for (const float by : {1.0F, 0.93F, 1.07F, 0.87F, 1.14F, 0.81F}) {
        const Waves waves =
            kernels.strongest_waves(x.data(), y.data(), static_cast<int>(count), by / spacing);
        if (waves.power > best.power) best = waves;
        if (best.power > tuned::kClearWaves * unit) break;
    }
    if (best.power < tuned::kFaintWaves * unit) return {};
    return best;
}

/// Returns the phase of wave i in cycles, in [-1/2, 1/2]. The error is at most 1/1000 cycle.
float phase_in_cycles(const Waves& waves, std::size_t i) {
    const float x = std::abs(waves.phase_cos[i]);
    const float y = std::abs(waves.phase_sin[i]);
    const float ratio = std::min(x, y) / std::max({x, y, 1e-20F});
    const float octant = ratio / (6.2831853F + 1.7593F * ratio * ratio);
    const float quarter = y > x ? 0.25F - octant : octant;
    const float half = waves.phase_cos[i] < 0 ? 0.5F - quarter : quarter;
    return waves.phase_sin[i] < 0 ? -half : half;
}

FloatPlane plane_from_waves(const Waves& waves) {
    FloatPlane plane;
    plane.at_x = -phase_in_cycles(waves, 0);
    plane.at_y = -phase_in_cycles(waves, 1);
    plane.du_x = waves.kx[0];
    plane.dv_x = waves.ky[0];
    plane.du_y = waves.kx[1];
    plane.dv_y = waves.ky[1];
    return plane;
}

/// The local density of the dots around a dot is measured by the distance from this dot to its
/// kNearest-th nearest neighbour. The first estimate of the grid spacing is computed from the
/// smallest of these distances.
constexpr std::size_t kNearest = 20;

/// Squared distances from one dot to all dots of a patch, in px^2.
using SquaredDistances = std::array<float, PatchDots::kMax>;

/// Returns the squared distance from the dot at `of` to its kNearest-th nearest neighbour, in px^2.
/// Overwrites `squares`.
float squared_reach_of_nearest(const PatchDots& dots, FloatVec of, SquaredDistances& squares) {
    const auto count = static_cast<std::size_t>(dots.count);
    for (std::size_t i = 0; i < count; ++i) {
        const float x = dots.x[i] - of.x;
        const float y = dots.y[i] - of.y;
        squares[i] = x * x + y * y;
    }
    const auto farthest = squares.begin() + kNearest;
    std::nth_element(squares.begin(), farthest, squares.begin() + count);
    return *farthest;
}

}  // namespace

PatchView whole_view(const Patch& patch) {
    const auto scale = static_cast<float>(patch.scale);
    const float area =
        static_cast<float>((patch.width_px - 4) * (patch.height_px - 4)) * scale * scale;
    return {std::sqrt(area / static_cast<float>(std::max(patch.dots.count, 1))),
            static_cast<float>(std::max(patch.width_px, patch.height_px) * patch.scale) / 2 + 1};
}

bool move_origin_to_densest(Patch& patch, PatchView& view, FloatVec& from_middle_px) {
    PatchDots& dots = patch.dots;
    const int count = dots.count;
    if (count < tuned::kMinDots) return false;
    // Limits on the number of dots that are tested as origins. Testing one dot takes time
    // proportional to the number of dots, so fewer dots are tested in noisy patches, which contain
    // many dots. The number of computed distances is limited to about kMaxDistances, but at least
    // kMinCandidates dots are tested.
    constexpr int kMaxCandidates = 64;
    constexpr int kMinCandidates = 16;
    constexpr int kMaxDistances = 32768;
    const int candidates = std::clamp(kMaxDistances / count, kMinCandidates, kMaxCandidates);
    const int step = count / candidates + 1;
    float min_reach_2 = kNoDot_px;
    SquaredDistances squares{};
    for (int i = 0; i < count; i += step) {
        const auto k = static_cast<std::size_t>(i);
        const FloatVec candidate{dots.x[k], dots.y[k]};
        const float reach_2 = squared_reach_of_nearest(dots, candidate, squares);
        if (reach_2 >= min_reach_2) continue;
        min_reach_2 = reach_2;
        // Uses whole pixels, so a plane can be moved to this origin without rounding errors.
        from_middle_px = {std::floor(candidate.x), std::floor(candidate.y)};
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        dots.x[i] -= from_middle_px.x;
        dots.y[i] -= from_middle_px.y;
    }
    view = whole_view(patch);
    view.full_reach_px += std::max(std::abs(from_middle_px.x), std::abs(from_middle_px.y));
    // A disc with n dots has about the area of n cells.
    view.spacing_px = std::sqrt(3.14159265F * min_reach_2 / (kNearest + 0.5F));
    return true;
}

bool find_grid(const Kernels& kernels, const Patch& patch, const PatchView& view, PatchGrid& grid) {
    if (patch.dots.count < view.min_dots) return false;
    const std::optional<Waves> waves = find_waves(kernels, patch, view);
    if (!waves) return false;
    GridFit fit(kernels, patch.dots, plane_from_waves(*waves), view.full_reach_px);
    if (!fit.start() || !fit.grow() || !fit.is_sufficient()) return false;
    grid = fit.grid();
    return true;
}

}  // namespace dotpose::core
