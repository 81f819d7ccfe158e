#include "core/lattice/axes.hpp"

#include <array>

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

constexpr int kMaxIterations = 10;  // Fig. 5
constexpr std::size_t kMostEdges = 2 * std::size_t{kMaxSeeds};
constexpr std::size_t kFewestEdges = 12;

using Values = std::array<std::int32_t, kMostEdges>;

std::int32_t length(Vec a) {
    return static_cast<std::int32_t>(square_root(static_cast<std::uint64_t>(squared(a))));
}

std::int32_t median_length(std::span<const Edge> edges, Values& scratch) {
    std::size_t n = 0;
    for (const Edge& edge : edges)
        scratch[n++] = length(edge.step_q8);
    return median(std::span(scratch).first(n));
}

/// Direction of the grid, modulo a quarter turn: the fourth powers of the edges as complex numbers
/// point the same way for all four directions of a grid.
std::int32_t common_direction_bam(std::span<const Edge> edges, std::int32_t length_q8) {
    std::int64_t sum_re = 0;
    std::int64_t sum_im = 0;
    for (const Edge& edge : edges) {
        const std::int64_t x = std::int64_t{edge.step_q8.x} * 1024 / length_q8;
        const std::int64_t y = std::int64_t{edge.step_q8.y} * 1024 / length_q8;
        const std::int64_t squared_length = x * x + y * y;
        // Diagonals would pull the wrong way, and would count fourfold.
        if (squared_length > 1280 * 1280 || squared_length < 512 * 512) continue;
        const std::int64_t re = (x * x - y * y) >> 10;
        const std::int64_t im = (2 * x * y) >> 10;
        sum_re += (re * re - im * im) >> 10;
        sum_im += (2 * re * im) >> 10;
    }
    // At most 2^9 edges of at most (5/4)^4 2^10.
    const std::int32_t four_fold =
        angle_bam({static_cast<std::int32_t>(sum_re), static_cast<std::int32_t>(sum_im)});
    return four_fold / 4;
}

/// The two clusters that are kept, of four: the others are their mirror images in the origin, which
/// is the constraint of Fig. 5. Returns the index of the nearest one and turns the edge towards it.
int nearest_cluster(Vec& edge, const std::array<Vec, 2>& means) {
    std::array<std::int64_t, 2> cost;
    std::array<std::int64_t, 2> projection;
    for (std::size_t k = 0; k < 2; ++k) {
        projection[k] = dot(edge, means[k]);
        // |edge -+ mean|^2 without the common |edge|^2
        cost[k] = squared(means[k]) - 2 * (projection[k] < 0 ? -projection[k] : projection[k]);
    }
    const std::size_t k = cost[1] < cost[0] ? 1 : 0;
    if (projection[k] < 0) edge = -edge;
    return static_cast<int>(k);
}

std::array<Vec, 2> constrained_k_means(std::span<const Edge> edges, std::array<Vec, 2> means) {
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
        std::array<Vec, 2> sums{};
        std::array<std::int32_t, 2> counts{};
        for (const Edge& edge : edges) {
            Vec step = edge.step_q8;
            const auto k = static_cast<std::size_t>(nearest_cluster(step, means));
            sums[k] = sums[k] + step;
            ++counts[k];
        }
        const std::array<Vec, 2> before = means;
        for (std::size_t k = 0; k < 2; ++k) {
            if (counts[k] == 0) continue;
            means[k] = {sums[k].x / counts[k], sums[k].y / counts[k]};
        }
        if (means == before) break;
    }
    return means;
}

/// Medians of the edges of one cluster, separately in x and y (last lines of Fig. 5).
Vec cluster_median(std::span<const Edge> edges, const std::array<Vec, 2>& means, int cluster,
                   Values& scratch) {
    Vec result;
    for (const auto member : {&Vec::x, &Vec::y}) {
        std::size_t n = 0;
        for (const Edge& edge : edges) {
            Vec step = edge.step_q8;
            if (nearest_cluster(step, means) == cluster) scratch[n++] = step.*member;
        }
        result.*member = median(std::span(scratch).first(n));
    }
    return result;
}

}  // namespace

Status estimate_axes(std::span<const Edge> edges, Lattice& lattice) {
    if (edges.size() < kFewestEdges) return Status::no_grid;
    Values scratch;
    const std::int32_t length_q8 = median_length(edges, scratch);
    if (length_q8 == 0) return Status::no_grid;
    const Vec unit = unit_q30(common_direction_bam(edges, length_q8));
    const Vec along{shift_rounded(std::int64_t{unit.x} * length_q8, 30),
                    shift_rounded(std::int64_t{unit.y} * length_q8, 30)};
    const auto means = constrained_k_means(edges, {along, Vec{-along.y, along.x}});
    const Vec u = cluster_median(edges, means, 0, scratch);
    const Vec v = cluster_median(edges, means, 1, scratch);
    // Symmetric edges are 4 % too short on average, because each dot chose its nearest: the
    // displacements along an edge that shorten it favour it. Measured in docs/pipeline.md.
    constexpr std::int32_t kLengthening_q8 = 267;
    lattice.u_q16 = {u.x * kLengthening_q8, u.y * kLengthening_q8};
    lattice.v_q16 = {v.x * kLengthening_q8, v.y * kLengthening_q8};
    return is_nearly_square(lattice.u_q16, lattice.v_q16) ? Status::ok : Status::no_grid;
}

bool is_nearly_square(Vec u, Vec v) {
    // Fourteen bits of the longer one are enough, and their fourth powers fit 64.
    int shift = 0;
    while (std::max({u.x, -u.x, u.y, -u.y, v.x, -v.x, v.y, -v.y}) >> shift >= 1 << 14)
        ++shift;
    u = {u.x >> shift, u.y >> shift};
    v = {v.x >> shift, v.y >> shift};
    const std::int64_t uu = squared(u);
    const std::int64_t vv = squared(v);
    const std::int64_t area = cross(u, v);
    // Lengths within 3:2, and the sine of the angle between at least 0.9.
    return area > 0 && 4 * uu <= 9 * vv && 4 * vv <= 9 * uu && 100 * (area * area / 81) >= uu * vv;
}

bool is_nearly_square(const PlaneFromImage& plane) {
    constexpr std::int32_t kSmallestSpacing_px = 4;
    return is_nearly_square(plane.du_q24, plane.dv_q24) &&
           squared(plane.du_q24) * kSmallestSpacing_px * kSmallestSpacing_px <= std::int64_t{1}
                                                                                    << 48;
}

}  // namespace dotpose::core
