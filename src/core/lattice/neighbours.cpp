#include "core/lattice/neighbours.hpp"

#include <algorithm>

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

constexpr int kDistanceBins = 64;

/// The seeds sorted into square buckets, so that near ones are found without looking at all.
class Buckets {
  public:
    Buckets(std::span<const Dot> dots, std::span<const std::uint16_t> seeds);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    std::int32_t size_q8() const { return 1 << shift_; }
    int first(int column, int row) const {
        return first_[static_cast<std::size_t>(row * columns_ + column)];
    }
    int next(int seed) const { return next_[static_cast<std::size_t>(seed)]; }
    int column(Vec point_q8) const { return (point_q8.x - corner_.x) >> shift_; }
    int row(Vec point_q8) const { return (point_q8.y - corner_.y) >> shift_; }

  private:
    static constexpr int kMost = kMaxSeeds;
    int shift_ = 0;
    int columns_ = 1;
    int rows_ = 1;
    Vec corner_;
    std::array<std::int16_t, kMost> first_;
    std::array<std::int16_t, kMaxSeeds> next_;
};

Buckets::Buckets(std::span<const Dot> dots, std::span<const std::uint16_t> seeds) {
    corner_ = dots[seeds[0]].centre_q8;
    Vec end = corner_;
    for (const std::uint16_t s : seeds) {
        const Vec p = dots[s].centre_q8;
        corner_ = {std::min(corner_.x, p.x), std::min(corner_.y, p.y)};
        end = {std::max(end.x, p.x), std::max(end.y, p.y)};
    }
    // One to four seeds a bucket: then the four nearest lie in the 3 x 3 buckets around.
    do {
        ++shift_;
        columns_ = column(end) + 1;
        rows_ = row(end) + 1;
    } while (columns_ > kMost || rows_ > kMost ||
             columns_ * rows_ > std::max(static_cast<int>(seeds.size()), 1));
    std::fill_n(first_.begin(), columns_ * rows_, std::int16_t{-1});
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        const Vec p = dots[seeds[s]].centre_q8;
        std::int16_t& head = first_[static_cast<std::size_t>(row(p) * columns_ + column(p))];
        next_[s] = head;
        head = static_cast<std::int16_t>(s);
    }
}

/// Distances squared, in 2^-16 px^2, up to 128 px per axis: no grid is coarser.
constexpr std::int32_t kFarthest_q8 = 1 << 15;
constexpr std::uint32_t kNone = UINT32_MAX;

/// The four nearest found so far, nearest first.
struct Nearest {
    std::array<std::int16_t, 4> seeds{-1, -1, -1, -1};
    std::array<std::uint32_t, 4> squared_q16{kNone, kNone, kNone, kNone};

    void offer(int seed, std::uint32_t distance) {
        if (distance >= squared_q16[3]) return;
        std::size_t i = 3;
        for (; i > 0 && distance < squared_q16[i - 1]; --i) {
            squared_q16[i] = squared_q16[i - 1];
            seeds[i] = seeds[i - 1];
        }
        squared_q16[i] = distance;
        seeds[i] = static_cast<std::int16_t>(seed);
    }
};

Nearest search(std::span<const Dot> dots, std::span<const std::uint16_t> seeds,
               const Buckets& buckets, int self, int reach) {
    const Vec p = dots[seeds[static_cast<std::size_t>(self)]].centre_q8;
    const int column = buckets.column(p);
    const int row = buckets.row(p);
    const int last_column = std::min(column + reach, buckets.columns() - 1);
    const int last_row = std::min(row + reach, buckets.rows() - 1);
    Nearest nearest;
    for (int r = std::max(row - reach, 0); r <= last_row; ++r) {
        for (int c = std::max(column - reach, 0); c <= last_column; ++c) {
            for (int s = buckets.first(c, r); s >= 0; s = buckets.next(s)) {
                const Vec d = dots[seeds[static_cast<std::size_t>(s)]].centre_q8 - p;
                if (s == self || magnitude(d.x) >= kFarthest_q8 || magnitude(d.y) >= kFarthest_q8) {
                    continue;
                }
                nearest.offer(s, static_cast<std::uint32_t>(d.x * d.x) +
                                     static_cast<std::uint32_t>(d.y * d.y));
            }
        }
    }
    return nearest;
}

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
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        Nearest nearest;
        const int most_reach = std::max(buckets.columns(), buckets.rows());
        for (int reach = 1; reach <= most_reach; ++reach) {
            nearest = search(dots, seeds, buckets, static_cast<int>(s), reach);
            const std::int32_t sure_q8 = reach * buckets.size_q8();
            if (sure_q8 >= kFarthest_q8 ||
                nearest.squared_q16[3] <= static_cast<std::uint32_t>(sure_q8 * sure_q8)) {
                break;
            }
        }
        neighbours[s] = nearest.seeds;
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
