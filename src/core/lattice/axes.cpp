#include "core/lattice/axes.hpp"

#include <array>
#include <bit>

#include "core/lattice/neighbours.hpp"
#include "core/math/fixed.hpp"
#include "core/noinline.hpp"

namespace dotpose::core {
namespace {

constexpr int kMaxIterations = 10;  // paper, figure 5
constexpr std::size_t kMaxEdges = 2 * std::size_t{kMaxSeeds};
constexpr std::size_t kMinEdges = 12;

using Values = std::span<std::int32_t>;

/// Returns the median edge length, in 2^-8 px. Ignores edges that extend 128 px or more along an
/// axis. Returns 0 if all edges are ignored.
std::int32_t median_length(std::span<const SeedEdge> edges, Values memory) {
    std::size_t n = 0;
    for (const SeedEdge& edge : edges) {
        // Skips long edges. Half the squared length of every other edge fits in 32 bits.
        if (!is_within(edge.step_q8, (1 << 15) - 1)) continue;
        const auto x = static_cast<std::uint32_t>(edge.step_q8.x * edge.step_q8.x);
        const auto y = static_cast<std::uint32_t>(edge.step_q8.y * edge.step_q8.y);
        memory[n++] = static_cast<std::int32_t>((x + y) / 2);
    }
    const auto half_square = static_cast<std::uint32_t>(median(memory.first(n)));
    return static_cast<std::int32_t>(square_root(half_square * 2));
}

/// Returns the grid direction that is at most 45 degrees from +x, as a binary angle (2^32 units per
/// turn). Treats the edges as complex numbers, and sums their fourth powers. Edges in all four grid
/// directions have the same fourth power, so the direction is a quarter of the angle of the sum.
/// `length_q8` is the median edge length.
std::int32_t common_direction_bam(std::span<const SeedEdge> edges, std::int32_t length_q8) {
    const std::int32_t inverse_q16 = 1024 * 65536 / length_q8;
    std::int32_t sum_re = 0;
    std::int32_t sum_im = 0;
    for (const SeedEdge& edge : edges) {
        const FixedVec step = edge.step_q8;
        if (!is_within(step, 2 * length_q8)) continue;
        const std::int32_t x = (step.x * inverse_q16) >> 16;
        const std::int32_t y = (step.y * inverse_q16) >> 16;
        const std::int32_t squared_length = x * x + y * y;
        // Uses only edges with 1/2 to 5/4 of the median length. Diagonal edges would cancel the
        // other edges, because their fourth powers have the opposite sign and four times the
        // magnitude.
        if (squared_length > 1280 * 1280 || squared_length < 512 * 512) continue;
        const std::int32_t re = (x * x - y * y) >> 10;
        const std::int32_t im = (2 * x * y) >> 10;
        sum_re += (re * re - im * im) >> 10;
        sum_im += (2 * re * im) >> 10;
    }
    // Each sum fits in 32 bits, because there are at most 2^9 edges, and each edge contributes at
    // most (5/4)^4 * 2^10.
    return angle_bam({sum_re, sum_im}) / 4;
}

/// Cluster to which an edge is assigned. An edge that points opposite to a cluster mean belongs to
/// the opposite cluster.
enum class Side : std::uint8_t { first, second, opposite_first, opposite_second, unknown };

std::size_t cluster_of(Side side) {
    return static_cast<std::size_t>(side) & 1;
}
/// Returns the edge, reversed if it points opposite to its cluster mean.
FixedVec turned(FixedVec edge, Side side) {
    return side >= Side::opposite_first ? -edge : edge;
}
using Sides = std::array<Side, kMaxEdges>;

struct Sum {
    FixedVec total;
    std::int32_t count = 0;

    void add(FixedVec edge, int times) {
        total = {total.x + times * edge.x, total.y + times * edge.y};
        count += times;
    }
};
using Sums = std::array<Sum, 5>;  ///< indexed by Side

/// Means of the first two of the four clusters. The means of the other two clusters are their
/// negatives (paper, figure 5).
class Clusters {
  public:
    explicit Clusters(const std::array<FixedVec, 2>& means_q8) : means_q8_(means_q8) {
        std::array<std::int32_t, 2> half_squares;
        for (std::size_t k = 0; k < 2; ++k) {
            means_q6_[k] = {means_q8[k].x >> 2, means_q8[k].y >> 2};
            const FixedVec m = means_q6_[k];
            half_squares[k] = (m.x * m.x + m.y * m.y) / 2;
        }
        farther_ = half_squares[1] - half_squares[0];
    }

    DOTPOSE_NOINLINE void assign(std::span<const SeedEdge> edges, Side* side, Sums& sums) const {
        for (const SeedEdge& edge : edges) {
            const Side now = nearest(edge.step_q8);
            if (now != *side) move(edge.step_q8, *side, now, sums);
            *side++ = now;
        }
    }
    /// Returns the cluster means. A cluster without edges keeps its previous mean.
    std::array<FixedVec, 2> means_q8(const Sums& sums) const {
        std::array<FixedVec, 2> means = means_q8_;
        for (std::size_t k = 0; k < 2; ++k) {
            const FixedVec total = sums[k].total - sums[k + 2].total;
            const std::int32_t count = sums[k].count + sums[k + 2].count;
            if (count > 0) means[k] = {total.x / count, total.y / count};
        }
        return means;
    }
    const std::array<FixedVec, 2>& means_q8() const { return means_q8_; }

  private:
    Side nearest(FixedVec edge_q8) const {
        const FixedVec e{edge_q8.x >> 2, edge_q8.y >> 2};
        const std::int32_t along_0 = e.x * means_q6_[0].x + e.y * means_q6_[0].y;
        const std::int32_t along_1 = e.x * means_q6_[1].x + e.y * means_q6_[1].y;
        // Assigns the edge to the mean with the smaller |mean|^2 / 2 - |edge . mean|. This is half
        // the squared distance from the edge to the nearer of mean and -mean, without the term
        // |edge|^2 / 2, which is the same for both means.
        if (magnitude(along_1) - magnitude(along_0) > farther_)
            return along_1 < 0 ? Side::opposite_second : Side::second;
        return along_0 < 0 ? Side::opposite_first : Side::first;
    }
    DOTPOSE_NOINLINE static void move(FixedVec edge, Side from, Side to, Sums& sums) {
        sums[static_cast<std::size_t>(from)].add(edge, -1);
        sums[static_cast<std::size_t>(to)].add(edge, 1);
    }

    std::array<FixedVec, 2> means_q8_;
    std::array<FixedVec, 2> means_q6_;  ///< in 2^-6 px, because products must fit in 32 bits
    /// (|mean 1|^2 - |mean 0|^2) / 2.
    std::int32_t farther_;
};

/// Determines the Side of each edge by constrained k-means (paper, figure 5).
void constrained_k_means(std::span<const SeedEdge> edges, Clusters clusters, Sides& sides) {
    std::fill_n(sides.begin(), edges.size(), Side::unknown);
    Sums sums{};
    for (int iteration = 0;; ++iteration) {
        clusters.assign(edges, sides.data(), sums);
        const std::array<FixedVec, 2> means = clusters.means_q8(sums);
        if (means == clusters.means_q8() || iteration == kMaxIterations) break;
        clusters = Clusters(means);
    }
}

/// Returns the median edge of a cluster, computed separately in x and y (paper, last lines of
/// figure 5).
FixedVec cluster_median(std::span<const SeedEdge> edges, const Sides& sides, std::size_t cluster,
                        Values memory) {
    const Values x = memory.first(edges.size());
    const Values y = memory.subspan(edges.size(), edges.size());
    std::size_t n = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (cluster_of(sides[e]) != cluster) continue;
        const FixedVec step = turned(edges[e].step_q8, sides[e]);
        x[n] = step.x;
        y[n++] = step.y;
    }
    return {median(x.first(n)), median(y.first(n))};
}

/// Returns the median edge of each cluster.
std::array<FixedVec, 2> medians(std::span<const SeedEdge> edges, const Clusters& clusters,
                                Values memory) {
    Sides sides;
    constrained_k_means(edges, clusters, sides);
    return {cluster_median(edges, sides, 0, memory), cluster_median(edges, sides, 1, memory)};
}

}  // namespace

Status estimate_axes(std::span<const SeedEdge> edges, Values memory, Lattice& lattice) {
    if (edges.size() < kMinEdges) return Status::no_grid;
    const std::int32_t length_q8 = median_length(edges, memory);
    if (length_q8 == 0) return Status::no_grid;
    const FixedVec unit = unit_q30(common_direction_bam(edges, length_q8));
    const FixedVec along{shift_rounded(std::int64_t{unit.x} * length_q8, 30),
                         shift_rounded(std::int64_t{unit.y} * length_q8, 30)};
    const Clusters clusters({along, FixedVec{-along.y, along.x}});
    const auto [u, v] = medians(edges, clusters, memory);
    // Correction factor for the axis lengths, in units of 1/256. Symmetric edges (see
    // `connect_symmetric`) are on average 4 % shorter than the spacing, because dots that are
    // displaced towards each other are more likely to be nearest neighbours.
    constexpr std::int32_t kLengthening_q8 = 267;
    if (!is_nearly_square(u, v)) return Status::no_grid;
    // Unlike the paper, which uses both medians as axes, this function rotates v by -90 degrees and
    // averages it with u. The mean is one axis of a square grid. The medians deviate from a square
    // grid mostly because of random errors, not because of camera tilt, so averaging halves the
    // variance.
    const FixedVec twice_u{u.x + v.y, u.y - v.x};
    lattice.u_q16 = {twice_u.x * kLengthening_q8 / 2, twice_u.y * kLengthening_q8 / 2};
    lattice.v_q16 = {-lattice.u_q16.y, lattice.u_q16.x};
    return Status::ok;
}

bool is_nearly_square(FixedVec u, FixedVec v) {
    // Keeps only the fourteen most significant bits, so that products of four components fit in 64
    // bits.
    const auto longest =
        static_cast<std::uint32_t>(std::max(larger_component(u), larger_component(v)));
    const int shift = std::max(static_cast<int>(std::bit_width(longest)) - 14, 0);
    u = {u.x >> shift, u.y >> shift};
    v = {v.x >> shift, v.y >> shift};
    const std::int32_t uu = u.x * u.x + u.y * u.y;
    const std::int32_t vv = v.x * v.x + v.y * v.y;
    const std::int32_t area = u.x * v.y - u.y * v.x;
    // sin^2 = squared_area / (uu * vv) must be at least 0.9^2 = 81 / 100.
    const std::int64_t squared_area = std::int64_t{area} * area;
    return area > 0 && std::int64_t{4} * uu <= std::int64_t{9} * vv &&
           std::int64_t{4} * vv <= std::int64_t{9} * uu &&
           25 * squared_area >= 81 * (std::int64_t{uu} * vv / 4);
}

bool is_nearly_square(const PlaneFromImage& plane) {
    constexpr std::int32_t kMinSpacing_px = 4;
    return is_nearly_square(plane.du_q24, plane.dv_q24) &&
           squared(plane.du_q24) * kMinSpacing_px * kMinSpacing_px <= std::int64_t{1} << 48;
}

}  // namespace dotpose::core
