#include "core/lattice/neighbours.hpp"

#include <algorithm>

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

constexpr int kDistanceBins = 64;

std::int32_t square_distance(Vec a, Vec b) {
    const Vec d = a - b;
    return std::max(std::max(d.x, -d.x), std::max(d.y, -d.y));
}

/// The seeds sorted into square buckets, so that near ones are found without looking at all.
class Buckets {
  public:
    Buckets(std::span<const Dot> dots, std::span<const std::uint16_t> seeds);

    int per_side() const { return per_side_; }
    std::int32_t size_q8() const { return size_q8_; }
    int first(int column, int row) const {
        return first_[static_cast<std::size_t>(row * per_side_ + column)];
    }
    int next(int seed) const { return next_[static_cast<std::size_t>(seed)]; }
    int index(std::int32_t offset_q8) const {
        return std::clamp(offset_q8 / size_q8_, 0, per_side_ - 1);
    }
    Vec corner() const { return corner_; }

  private:
    static constexpr int kMostPerSide = 11;
    int per_side_ = 1;
    std::int32_t size_q8_ = 1;
    Vec corner_;
    std::array<std::int16_t, kMostPerSide * kMostPerSide> first_;
    std::array<std::int16_t, kMaxSeeds> next_;
};

Buckets::Buckets(std::span<const Dot> dots, std::span<const std::uint16_t> seeds) {
    // About two seeds a bucket: then the four nearest lie in the 3 x 3 buckets around.
    while (per_side_ < kMostPerSide && 2 * per_side_ * per_side_ < static_cast<int>(seeds.size())) {
        ++per_side_;
    }
    corner_ = dots[seeds[0]].centre_q8;
    Vec end = corner_;
    for (const std::uint16_t s : seeds) {
        const Vec p = dots[s].centre_q8;
        corner_ = {std::min(corner_.x, p.x), std::min(corner_.y, p.y)};
        end = {std::max(end.x, p.x), std::max(end.y, p.y)};
    }
    size_q8_ = std::max(end.x - corner_.x, end.y - corner_.y) / per_side_ + 1;
    first_.fill(-1);
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        const Vec p = dots[seeds[s]].centre_q8 - corner_;
        std::int16_t& head = first_[static_cast<std::size_t>(index(p.y) * per_side_ + index(p.x))];
        next_[s] = head;
        head = static_cast<std::int16_t>(s);
    }
}

/// The four nearest found so far, nearest first.
struct Nearest {
    std::array<std::int16_t, 4> seeds{-1, -1, -1, -1};
    std::array<std::int64_t, 4> squared_q16{INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX};

    void offer(int seed, std::int64_t distance) {
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
               const Buckets& buckets, std::size_t self, int reach) {
    const Vec p = dots[seeds[self]].centre_q8;
    const int column = buckets.index(p.x - buckets.corner().x);
    const int row = buckets.index(p.y - buckets.corner().y);
    const int last = buckets.per_side() - 1;
    Nearest nearest;
    for (int r = std::max(row - reach, 0); r <= std::min(row + reach, last); ++r) {
        for (int c = std::max(column - reach, 0); c <= std::min(column + reach, last); ++c) {
            for (int s = buckets.first(c, r); s >= 0; s = buckets.next(s)) {
                if (s == static_cast<int>(self)) continue;
                nearest.offer(s, squared(dots[seeds[static_cast<std::size_t>(s)]].centre_q8 - p));
            }
        }
    }
    return nearest;
}

}  // namespace

int choose_seeds(std::span<const Dot> dots, Vec centre_q8, std::span<std::uint16_t> seeds) {
    std::int32_t farthest = 1;
    for (const Dot& dot : dots) {
        farthest = std::max(farthest, square_distance(dot.centre_q8, centre_q8));
    }
    std::array<std::uint16_t, kDistanceBins> histogram{};
    const auto bin_of = [&](const Dot& dot) {
        const std::int64_t distance = square_distance(dot.centre_q8, centre_q8);
        return static_cast<std::size_t>(distance * (kDistanceBins - 1) / farthest);
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
        for (int reach = 1; reach <= buckets.per_side(); ++reach) {
            nearest = search(dots, seeds, buckets, s, reach);
            const std::int64_t sure_q8 = std::int64_t{reach} * buckets.size_q8();
            if (nearest.squared_q16[3] <= sure_q8 * sure_q8) break;
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
