#include "core/decode/expected_rivals.hpp"

#include <bit>

#include "code/basis.hpp"

namespace dotpose::core {
namespace {

/// The sequences' digits are not quite evenly spread and not quite independent; this factor for
/// each step is more than the worst of them shows.
constexpr float kUnevenness = 1.1F;

std::size_t wrapped(int shift) {
    return static_cast<std::size_t>((shift % kSections + kSections) % kSections);
}

}  // namespace

ExpectedRivals::ExpectedRivals(int most_shared)
    : most_shared_(static_cast<std::size_t>(most_shared)) {
    std::size_t n = 0;
    for (unsigned different = 0; different < 16; ++different) {
        if (std::popcount(different) < 2) continue;
        Set& set = sets_[n++];
        set.rivals = 1;
        set.steps[0] = 1;
        for (std::size_t k = 0; k < 4; ++k) {
            if ((different >> k & 1) == 0) continue;
            const code::Secondary& a = code::basis(Profile::anoto)[k];
            set.rivals *= static_cast<float>(a.length);
            // Two digits below the base differ by d in (base - |d|) of base^2 cases.
            const auto base = static_cast<int>(a.base);
            ByShift steps{};
            for (int d = 1 - base; d < base; ++d) {
                const float probability =
                    static_cast<float>(base - (d < 0 ? -d : d)) / static_cast<float>(base * base);
                for (int s = 0; s < kSections; ++s) {
                    steps[wrapped(s + d * a.weight)] +=
                        probability * set.steps[static_cast<std::size_t>(s)];
                }
            }
            set.steps = steps;
        }
        for (float& step : set.steps)
            step *= kUnevenness;
    }
}

void ExpectedRivals::add_line(const ByShift& odds) {
    for (Set& set : sets_) {
        if (is_first_) {
            set.sums = odds;
            set.sums[0] = 0;
            set.shared[0] = odds[0];
            continue;
        }
        ByShift before = set.sums;
        for (const float sum : set.shared)
            before[0] += sum;
        ByShift after{};
        for (int s = 0; s < kSections; ++s) {
            const float sum = before[static_cast<std::size_t>(s)];
            // Too little to matter, whatever follows: 4e8 rivals at these odds.
            if (sum < 1e-30F) continue;
            for (int d = 0; d < kSections - s; ++d) {
                after[static_cast<std::size_t>(s + d)] +=
                    sum * set.steps[static_cast<std::size_t>(d)];
            }
            for (int d = kSections - s; d < kSections; ++d) {
                after[static_cast<std::size_t>(s + d - kSections)] +=
                    sum * set.steps[static_cast<std::size_t>(d)];
            }
        }
        // Back at shift 0 a new run of shared lines begins; within one, it grows.
        float returned = after[0] - before[0] * set.steps[0];
        returned = returned > 0 ? returned : 0;
        for (std::size_t i = most_shared_ - 1; i > 0; --i) {
            set.shared[i] = set.shared[i - 1] * set.steps[0] * odds[0];
        }
        set.shared[0] = returned * odds[0];
        for (std::size_t s = 1; s < odds.size(); ++s)
            set.sums[s] = after[s] * odds[s];
    }
    is_first_ = false;
}

float ExpectedRivals::sum() const {
    float total = 0;
    for (const Set& set : sets_) {
        float sum = 0;
        for (const float s : set.sums)
            sum += s;
        for (const float s : set.shared)
            sum += s;
        total += sum * set.rivals;
    }
    return total;
}

}  // namespace dotpose::core
