#include "core/lattice/neighbours.hpp"

#include <algorithm>

#include "core/math/fixed.hpp"
#include "core/noinline.hpp"

namespace dotpose::core {
namespace {

constexpr int kDistanceBins = 64;

/// The seeds, sorted into square buckets in row-major order. Seeds that are close in the image are
/// also close in memory.
class Buckets {
  public:
    Buckets(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
            std::span<BucketedSeed> memory);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    std::int32_t size_q8() const { return 1 << shift_; }
    int column(FixedVec at_q8) const { return at_q8.x >> shift_; }
    int row(FixedVec at_q8) const { return at_q8.y >> shift_; }
    std::span<const BucketedSeed> all() const { return memory_.first(count_); }
    /// Returns the first seed in the bucket at this row and column, or the next seed in the array
    /// if the bucket is empty.
    const BucketedSeed* in_row(int row, int column) const {
        return &memory_[memory_[static_cast<std::size_t>(row * columns_ + column)].begin];
    }

  private:
    /// The seeds and the buckets (see BucketedSeed). A sentinel bucket at index columns * rows
    /// follows the last bucket. Its `begin` is the end of the last bucket.
    const std::span<BucketedSeed> memory_;
    const std::size_t count_;
    int shift_ = 0;
    int columns_ = 1;
    int rows_ = 1;
};

Buckets::Buckets(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                 std::span<BucketedSeed> memory)
    : memory_(memory), count_(seeds.size()) {
    FixedVec corner = dots[seeds[0]].centre_q8;
    FixedVec end = corner;
    for (const std::uint16_t s : seeds) {
        const FixedVec p = dots[s].centre_q8;
        corner = {std::min(corner.x, p.x), std::min(corner.y, p.y)};
        end = {std::max(end.x, p.x), std::max(end.y, p.y)};
    }
    // Chooses the bucket size so that a bucket contains one to four seeds on average. The 3 x 3
    // buckets around a seed then usually contain its four nearest neighbours.
    const int max_buckets = static_cast<int>(seeds.size());
    do {
        ++shift_;
        columns_ = ((end.x - corner.x) >> shift_) + 1;
        rows_ = ((end.y - corner.y) >> shift_) + 1;
    } while (columns_ > max_buckets || rows_ > max_buckets || columns_ * rows_ > max_buckets);
    // Counting sort: counts the seeds of each bucket, sets the bucket ends, then fills the buckets
    // backwards.
    const auto buckets = static_cast<std::size_t>(columns_ * rows_);
    for (BucketedSeed& bucket : memory_.first(buckets + 1))
        bucket.begin = 0;
    const auto begin_of = [&](FixedVec at_q8) -> std::uint16_t& {
        return memory_[static_cast<std::size_t>(row(at_q8) * columns_ + column(at_q8))].begin;
    };
    for (const std::uint16_t s : seeds)
        ++begin_of(dots[s].centre_q8 - corner);
    for (std::size_t k = 1; k <= buckets; ++k)
        memory_[k].begin = static_cast<std::uint16_t>(memory_[k].begin + memory_[k - 1].begin);
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        const FixedVec at_q8 = dots[seeds[s]].centre_q8 - corner;
        BucketedSeed& place = memory_[--begin_of(at_q8)];
        place.at_q8 = at_q8;
        place.seed = static_cast<std::uint16_t>(s);
    }
}

/// Exclusive upper bound on the distance to a neighbour along each axis: 128 px. Larger grid
/// spacings are not supported here.
constexpr std::int32_t kFarthest_q8 = 1 << 15;

/// Returns a^2 modulo 2^32.
std::uint32_t wrapped_square(std::int32_t a) {
    return static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(a);
}

/// The four nearest seeds found so far, nearest first.
class Nearest {
  public:
    /// Accepts only seeds with a squared distance from `self` below `within_q16`. `may_be_far` must
    /// be true if `search` may test seeds that are 128 px or more away along an axis.
    Nearest(const BucketedSeed& self, std::uint32_t within_q16, bool may_be_far)
        : self_(self), may_be_far_(may_be_far) {
        for (std::size_t k = 0; k < points_.size(); ++k) {
            squared_q16_[k] = within_q16;
            points_[k] = nullptr;
        }
    }

    DOTPOSE_NOINLINE void search(const BucketedSeed* p, const BucketedSeed* end) {
        const auto [x, y] = self_.at_q8;
        std::uint32_t farthest_q16 = squared_q16_[3];
        for (; p != end; ++p) {
            // The squared distance of a far seed may wrap to a small number. `consider` rejects
            // such seeds.
            const std::uint32_t squared_q16 =
                wrapped_square(p->at_q8.x - x) + wrapped_square(p->at_q8.y - y);
            if (squared_q16 < farthest_q16) farthest_q16 = consider(p, squared_q16);
        }
    }
    bool has_four() const { return points_[3] != nullptr; }
    /// Writes the indices of the four seeds, with -1 for each missing seed.
    void write(std::array<std::int16_t, 4>& seeds) const {
        for (std::size_t k = 0; k < seeds.size(); ++k)
            seeds[k] = points_[k] == nullptr ? -1 : static_cast<std::int16_t>(points_[k]->seed);
    }

  private:
    /// Inserts seed `p` if it is not `self_` and is less than 128 px away along each axis.
    /// `squared_q16` is its squared distance, which must be less than that of the fourth nearest
    /// seed. Returns the new squared distance of the fourth nearest seed, which limits further
    /// candidates.
    DOTPOSE_NOINLINE std::uint32_t consider(const BucketedSeed* p, std::uint32_t squared_q16) {
        const bool is_far = may_be_far_ && larger_component(p->at_q8 - self_.at_q8) >= kFarthest_q8;
        if (p != &self_ && !is_far) insert<3>(p, squared_q16);
        return squared_q16_[3];
    }
    template <std::size_t kPlace>
    void insert(const BucketedSeed* p, std::uint32_t squared_q16) {
        if constexpr (kPlace > 0) {
            if (squared_q16 < squared_q16_[kPlace - 1]) {
                squared_q16_[kPlace] = squared_q16_[kPlace - 1];
                points_[kPlace] = points_[kPlace - 1];
                insert<kPlace - 1>(p, squared_q16);
                return;
            }
        }
        squared_q16_[kPlace] = squared_q16;
        points_[kPlace] = p;
    }

    const BucketedSeed& self_;
    bool may_be_far_;
    std::array<const BucketedSeed*, 4> points_;
    std::array<std::uint32_t, 4> squared_q16_;
};

/// Doubles the bin width, by merging pairs of adjacent bins.
void widen(std::array<std::uint16_t, kDistanceBins>& histogram) {
    for (std::size_t k = 0; k < kDistanceBins / 2; ++k) {
        histogram[k] = static_cast<std::uint16_t>(histogram[2 * k] + histogram[2 * k + 1]);
    }
    std::fill(histogram.begin() + kDistanceBins / 2, histogram.end(), std::uint16_t{0});
}

}  // namespace

int choose_seeds(std::span<const DetectedDot> dots, FixedVec centre_q8,
                 std::span<std::uint16_t> seeds) {
    // Histogram of the distances from the centre. The bin width is the smallest power of two for
    // which the histogram includes the farthest dot.
    std::array<std::uint16_t, kDistanceBins> histogram{};
    int shift = 0;
    for (const DetectedDot& dot : dots) {
        const std::int32_t distance = larger_component(dot.centre_q8 - centre_q8);
        for (; distance >> shift >= kDistanceBins; ++shift) {
            if (&dot != dots.data()) widen(histogram);
        }
        ++histogram[static_cast<std::size_t>(distance >> shift)];
    }
    std::size_t bins = 1;
    for (std::size_t total = histogram[0]; bins < kDistanceBins; ++bins) {
        total += histogram[bins];
        if (total > seeds.size()) break;
    }
    const std::int32_t reach_q8 = static_cast<std::int32_t>(bins) << shift;
    std::size_t count = 0;
    for (std::size_t i = 0; i < dots.size() && count < seeds.size(); ++i) {
        const FixedVec step = dots[i].centre_q8 - centre_q8;
        if (is_within(step, reach_q8 - 1)) {
            seeds[count++] = static_cast<std::uint16_t>(i);
        }
    }
    return static_cast<int>(count);
}

void find_neighbours(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                     std::span<BucketedSeed> memory,
                     std::span<std::array<std::int16_t, 4>> neighbours) {
    if (seeds.empty()) return;
    const Buckets buckets(dots, seeds, memory);
    const int max_reach = std::max(buckets.columns(), buckets.rows());
    for (const BucketedSeed& p : buckets.all()) {
        const int column = buckets.column(p.at_q8);
        const int row = buckets.row(p.at_q8);
        for (int reach = 1;; ++reach) {
            const std::int32_t sure_q8 = reach * buckets.size_q8();
            const bool is_last = reach >= max_reach || sure_q8 >= kFarthest_q8;
            const auto within_q16 =
                is_last ? UINT32_MAX : static_cast<std::uint32_t>(sure_q8 * sure_q8);
            // The searched buckets contain all seeds within sure_q8 of p along each axis, and no
            // seed that is more than twice as far away along any axis.
            Nearest nearest(p, within_q16, 2 * sure_q8 > kFarthest_q8);
            const int left = std::max(column - reach, 0);
            const int right = std::min(column + reach, buckets.columns() - 1);
            const int bottom = std::min(row + reach, buckets.rows() - 1);
            for (int r = std::max(row - reach, 0); r <= bottom; ++r)
                nearest.search(buckets.in_row(r, left), buckets.in_row(r, right + 1));
            if (!nearest.has_four() && !is_last) continue;
            nearest.write(neighbours[p.seed]);
            break;
        }
    }
}

namespace {

/// Indices of two seeds. `from` is the lower index.
struct Pair {
    std::int16_t from;
    std::int16_t to;
};

SeedEdge edge_along(Pair pair, FixedVec step) {
    const auto [from, to] = pair;
    const bool is_up = step.y < 0 || (step.y == 0 && step.x < 0);
    return is_up ? SeedEdge{to, from, -step} : SeedEdge{from, to, step};
}

using Neighbours = std::span<const std::array<std::int16_t, 4>>;

}  // namespace

int connect_symmetric(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                      Neighbours neighbours, std::span<SeedEdge> edges) {
    std::size_t count = 0;
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        const auto from = static_cast<std::int16_t>(s);
        for (const std::int16_t to : neighbours[s]) {
            if (to <= from || !counts(neighbours, to, from)) continue;
            const FixedVec step =
                dots[seeds[static_cast<std::size_t>(to)]].centre_q8 - dots[seeds[s]].centre_q8;
            edges[count++] = edge_along({from, to}, step);
        }
    }
    return static_cast<int>(count);
}

}  // namespace dotpose::core
