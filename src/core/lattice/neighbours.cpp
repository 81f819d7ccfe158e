#include "core/lattice/neighbours.hpp"

#include <algorithm>

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

constexpr int kDistanceBins = 64;

/// The seeds sorted into square buckets, row by row, so that near ones lie together.
class Buckets {
  public:
    struct Seed {
        std::int32_t x_q8;  ///< from the corner of the first bucket
        std::int32_t y_q8;
        std::int16_t index;
    };

    Buckets(std::span<const Dot> dots, std::span<const std::uint16_t> seeds);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    std::int32_t size_q8() const { return 1 << shift_; }
    int column(Vec point_q8) const { return point_q8.x >> shift_; }
    int row(Vec point_q8) const { return point_q8.y >> shift_; }
    std::span<const Seed> all() const { return std::span(sorted_).first(count_); }
    /// Those in the columns from `first` to `last` of one row, as far as these exist.
    std::span<const Seed> in_row(int row, int first, int last) const {
        if (row < 0 || row >= rows_) return {};
        const std::uint16_t* const begins = &begin_[static_cast<std::size_t>(row * columns_)];
        const std::size_t begin = begins[std::clamp(first, 0, columns_)];
        const std::size_t end = begins[std::clamp(last + 1, 0, columns_)];
        return {&sorted_[begin], end - begin};
    }

  private:
    int shift_ = 0;
    int columns_ = 1;
    int rows_ = 1;
    std::size_t count_;
    std::array<std::uint16_t, kMaxSeeds + 1> begin_;  ///< of each bucket, and where the last ends
    std::array<Seed, kMaxSeeds> sorted_;
};

Buckets::Buckets(std::span<const Dot> dots, std::span<const std::uint16_t> seeds)
    : count_(seeds.size()) {
    Vec corner = dots[seeds[0]].centre_q8;
    Vec end = corner;
    for (const std::uint16_t s : seeds) {
        const Vec p = dots[s].centre_q8;
        corner = {std::min(corner.x, p.x), std::min(corner.y, p.y)};
        end = {std::max(end.x, p.x), std::max(end.y, p.y)};
    }
    // One to four seeds a bucket: then the four nearest lie in the 3 x 3 buckets around.
    const int most = static_cast<int>(seeds.size());
    do {
        ++shift_;
        columns_ = column(end - corner) + 1;
        rows_ = row(end - corner) + 1;
    } while (columns_ > most || rows_ > most || columns_ * rows_ > most);
    // Counted, then where each bucket ends, then filled from there backwards.
    const int buckets = columns_ * rows_;
    std::fill_n(begin_.begin(), buckets + 1, std::uint16_t{0});
    const auto bucket_of = [&](Vec p) {
        return static_cast<std::size_t>(row(p) * columns_ + column(p));
    };
    for (const std::uint16_t s : seeds)
        ++begin_[bucket_of(dots[s].centre_q8 - corner)];
    for (std::size_t k = 1; k <= static_cast<std::size_t>(buckets); ++k)
        begin_[k] = static_cast<std::uint16_t>(begin_[k] + begin_[k - 1]);
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        const Vec p = dots[seeds[s]].centre_q8 - corner;
        sorted_[--begin_[bucket_of(p)]] = {p.x, p.y, static_cast<std::int16_t>(s)};
    }
}

/// Distances squared, in 2^-16 px^2, up to 128 px per axis: no grid is coarser.
constexpr std::int32_t kFarthest_q8 = 1 << 15;

/// The four nearest of one seed found so far, nearest first.
class Nearest {
  public:
    /// Nearer than the square root of `within_q16`.
    Nearest(const Buckets::Seed& self, std::uint32_t within_q16) : self_(self) {
        squared_q16_.fill(within_q16);
    }

    void search(std::span<const Buckets::Seed> seeds) {
        for (const Buckets::Seed& seed : seeds) {
            // Too far off for 32 bits, it may be taken for near, but is not kept.
            const Vec d{seed.x_q8 - self_.x_q8, seed.y_q8 - self_.y_q8};
            const std::uint32_t distance = wrapped_square(d.x) + wrapped_square(d.y);
            if (distance >= squared_q16_[3] || &seed == &self_) continue;
            if (larger_component(d) < kFarthest_q8) insert<3>(seed.index, distance);
        }
    }
    bool are_four() const { return seeds_[3] >= 0; }
    const std::array<std::int16_t, 4>& seeds() const { return seeds_; }

  private:
    static std::uint32_t wrapped_square(std::int32_t a) {
        return static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(a);
    }
    template <std::size_t kPlace>
    void insert(std::int16_t seed, std::uint32_t distance) {
        if constexpr (kPlace > 0) {
            if (distance < squared_q16_[kPlace - 1]) {
                squared_q16_[kPlace] = squared_q16_[kPlace - 1];
                seeds_[kPlace] = seeds_[kPlace - 1];
                insert<kPlace - 1>(seed, distance);
                return;
            }
        }
        squared_q16_[kPlace] = distance;
        seeds_[kPlace] = seed;
    }

    const Buckets::Seed& self_;
    std::array<std::int16_t, 4> seeds_{-1, -1, -1, -1};
    std::array<std::uint32_t, 4> squared_q16_;
};

}  // namespace

int choose_seeds(std::span<const Dot> dots, Vec centre_q8, std::span<std::uint16_t> seeds) {
    std::int32_t farthest = 1;
    for (const Dot& dot : dots) {
        farthest = std::max(farthest, larger_component(dot.centre_q8 - centre_q8));
    }
    int shift = 0;
    while (farthest >> shift >= kDistanceBins)
        ++shift;
    std::array<std::uint16_t, kDistanceBins> histogram{};
    const auto bin_of = [&](const Dot& dot) {
        return static_cast<std::size_t>(larger_component(dot.centre_q8 - centre_q8) >> shift);
    };
    for (const Dot& dot : dots)
        ++histogram[bin_of(dot)];
    std::size_t bins = 1;
    for (std::size_t total = histogram[0]; bins < kDistanceBins; ++bins) {
        total += histogram[bins];
        if (total > seeds.size()) break;
    }
    int count = 0;
    for (std::size_t i = 0; i < dots.size() && count < static_cast<int>(seeds.size()); ++i) {
        if (bin_of(dots[i]) < bins) {
            seeds[static_cast<std::size_t>(count++)] = static_cast<std::uint16_t>(i);
        }
    }
    return count;
}

void find_neighbours(std::span<const Dot> dots, std::span<const std::uint16_t> seeds,
                     std::span<std::array<std::int16_t, 4>> neighbours) {
    if (seeds.empty()) return;
    const Buckets buckets(dots, seeds);
    const int most_reach = std::max(buckets.columns(), buckets.rows());
    for (const Buckets::Seed& seed : buckets.all()) {
        const int column = buckets.column({seed.x_q8, seed.y_q8});
        const int row = buckets.row({seed.x_q8, seed.y_q8});
        for (int reach = 1;; ++reach) {
            const std::int32_t sure_q8 = reach * buckets.size_q8();
            const bool is_last = reach >= most_reach || sure_q8 >= kFarthest_q8;
            Nearest nearest(seed,
                            is_last ? UINT32_MAX : static_cast<std::uint32_t>(sure_q8 * sure_q8));
            for (int r = row - reach; r <= row + reach; ++r)
                nearest.search(buckets.in_row(r, column - reach, column + reach));
            if (!is_last && !nearest.are_four()) continue;
            neighbours[static_cast<std::size_t>(seed.index)] = nearest.seeds();
            break;
        }
    }
}

int connect_symmetric(std::span<const Dot> dots, std::span<const std::uint16_t> seeds,
                      std::span<const std::array<std::int16_t, 4>> neighbours,
                      std::span<Edge> edges) {
    int count = 0;
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        for (const std::int16_t to : neighbours[s]) {
            if (to <= static_cast<int>(s) || !counts(neighbours, to, static_cast<int>(s))) continue;
            Edge edge{static_cast<std::int16_t>(s), to, {}};
            edge.step_q8 =
                dots[seeds[static_cast<std::size_t>(to)]].centre_q8 - dots[seeds[s]].centre_q8;
            if (edge.step_q8.y < 0 || (edge.step_q8.y == 0 && edge.step_q8.x < 0)) {
                std::swap(edge.from, edge.to);
                edge.step_q8 = -edge.step_q8;
            }
            edges[static_cast<std::size_t>(count++)] = edge;
        }
    }
    return count;
}

}  // namespace dotpose::core
